# SPDX-License-Identifier: MIT
"""Calls for a controller, as exchange.h writes them: recorded runs, and inputs made up by chance.

A stimulus is what one controller is told from its start on: a configuration, then steps and what an
operator says between them.
"""

import random
import struct
from dataclasses import dataclass, field

INIT, STEP, SETPOINT, MODE, MANUAL_FLUX, TAKE, RESTORE = range(1, 8)
OFF, MANUAL, AUTOMATIC = range(3)

HAS_LEVEL, HAS_OUTLET_FLUX, HAS_APPLIED_FLUX, HAS_DENSITY, HAS_SAMPLE_COUNT, HAS_TICKS = (
    1 << bit for bit in range(6)
)

# In exchange.c's order.
REALS = [
    "belt_length",
    "processing_time",
    "speed_window",
    "congestion_scale",
    "connectivity",
    "service_rate_max",
    "service_time",
    "level_capacity",
    "rework_rate",
    "level_setpoint",
    "nominal_flux_max",
    "slope",
    "period",
    "inlet_flux_max",
    "estimator_time",
    "flux_rate_max",
    "substitute_flux",
    "level_step_max",
    "transfer_time",
]
COUNTS = ["node_count", "sample_periods", "hold_periods", "recovery_samples", "loss_count"]
KINDS = ["slope_kind", "prediction", "estimator"]

PAPER = dict.fromkeys(REALS, 0.0) | {
    "belt_length": 2.0,
    "processing_time": 0.25,
    "speed_window": 0.2,
    "congestion_scale": 1.0,
    "connectivity": 0.5,
    "service_rate_max": 0.8,
    "service_time": 1.0,
    "level_capacity": 1.0,
    "rework_rate": 0.1,
    "level_setpoint": 0.3,
    "nominal_flux_max": 1.2,
    "slope": 20.0,
    "period": 0.0025,
    "inlet_flux_max": 3e38,
    **dict.fromkeys(COUNTS + KINDS, 0),
    "node_count": 20,
}


def bits(number):
    return struct.unpack("<I", struct.pack("<f", number))[0]


def message(what, words=()):
    return struct.pack(f"<{2 + len(words)}I", what, len(words), *words)


def messages(stream):
    """What each is, and its words."""
    at = 0
    while at < len(stream):
        what, count = struct.unpack_from("<2I", stream, at)
        yield what, struct.unpack_from(f"<{count}I", stream, at + 8)
        at += 8 + 4 * count


def init(config, loss):
    words = [bits(config[name]) for name in REALS]
    words += [len(loss) if name == "loss_count" else config[name] for name in COUNTS]
    return message(INIT, words + [config[name] for name in KINDS] + [bits(rate) for rate in loss])


def step(level, outlet_flux, applied_flux, sample, ticks, density, present):
    words = [present, bits(level), bits(outlet_flux), bits(applied_flux), sample, ticks]
    return message(STEP, words + [bits(value) for value in density])


@dataclass
class Genes:
    """What a made-up stimulus is grown from: drawn by chance, inherited with changes."""

    seed: int
    config: dict
    loss: list
    steps: int
    kinds: list = field(default_factory=list)  # how the level moves, segment by segment


# Where the history's window, the belt's way in a period and the numbers themselves are extreme.
CHOICES = {
    "speed_window": ["one period", "half", "whole", 0.2, 0.05],
    "period": [0.0025, 0.001, "a cell", "nearly a cell", "half a cell"],
    "congestion_scale": [1.0, 0.5, 0.25, 2.0, 10.0],
    "rework_rate": [0.1, 0.0, 0.4],
    "level_setpoint": [0.3, 0.05, 0.5],
    "service_rate_max": [0.8, 0.6],
    "flux_rate_max": [0.0, 20.0],
    "loss": [1.0, 0.0, 2.0],
}
MOVES = ["rest", "rise", "fall", "walk", "jump", "full", "empty", "anything"]
GOOD_MOVES = ["rest", "rise", "fall", "walk", "jump", "full", "empty"]
SEGMENTS = 6


def choose(chance, mode, node_count, window_capacity):
    genes = Genes(chance.getrandbits(32), {}, [], chance.choice([40, 120, 240]))
    genes.config = {name: chance.choice(values) for name, values in CHOICES.items()}
    genes.config["node_count"] = node_count
    genes.config["window_capacity"] = window_capacity
    genes.kinds = [chance.choice(moves_of(mode)) for _ in range(SEGMENTS)]
    return genes


def moves_of(mode):
    return GOOD_MOVES if mode == "law" else MOVES


def change(chance, genes, mode):
    """A descendant: one or two of its genes are others."""
    child = Genes(genes.seed, dict(genes.config), genes.loss, genes.steps, list(genes.kinds))
    for _ in range(chance.choice([1, 1, 2])):
        which = chance.randrange(3)
        if which == 0:
            child.seed = chance.getrandbits(32)
        elif which == 1:
            name = chance.choice(list(CHOICES))
            child.config[name] = chance.choice(CHOICES[name])
        else:
            child.kinds[chance.randrange(SEGMENTS)] = chance.choice(moves_of(mode))
    return child


def settle(genes, mode):
    """The configuration in numbers, and the losses."""
    config = PAPER | {
        name: value for name, value in genes.config.items() if not isinstance(value, str)
    }
    loss = [config.pop("loss")]
    if mode in ("profile", "late"):
        loss = [loss[0] * share for share in (0.4, 1.2, 1.6, 0.8, 0.5)]
    capacity = config.pop("window_capacity")
    cell = 0.9999 * config["belt_length"] * config["processing_time"] / config["node_count"]
    period = {"a cell": cell, "nearly a cell": 0.98 * cell, "half a cell": 0.501 * cell}.get(
        genes.config["period"], genes.config["period"]
    )
    config["period"] = period = min(period, cell)
    longest = (capacity - 2) * period
    window = {"one period": period * 1.001, "half": 0.5 * longest, "whole": longest * 0.999}.get(
        genes.config["speed_window"], genes.config["speed_window"]
    )
    config["speed_window"] = min(max(window, period * 1.001), longest * 0.999, 1.0)
    config["estimator"] = 0 if mode == "law" else 1
    config["slope"] = min(20.0, 0.2 / period)
    return config, loss


def move(chance, kind, level):
    target = {"rise": level + 0.01, "fall": level - 0.01, "full": level + 0.1, "empty": level - 0.1}
    if kind in target:
        return min(1.0, max(0.0, target[kind]))
    if kind == "walk":
        return min(1.0, max(0.0, level + chance.uniform(-0.05, 0.05)))
    if kind == "jump":
        return min(1.0, max(0.0, level + chance.choice([-0.2, 0.2])))
    return level


def garbage(chance):
    return chance.choice([float("nan"), float("inf"), -1.0, 1e30, 0.0, chance.uniform(-1, 3)])


def grow(genes, mode):
    """The stimulus itself, as bytes."""
    chance = random.Random(genes.seed)
    config, loss = settle(genes, mode)
    parts = [init(config, loss)]
    places = config["node_count"] + 1
    level = chance.choice([0.0, 0.3, 1.0])
    sample = 0
    for index in range(genes.steps):
        kind = genes.kinds[index * SEGMENTS // genes.steps]
        level = move(chance, kind, level)
        anything = kind == "anything"
        if chance.random() < 0.02:
            parts.append(message(SETPOINT, [bits(chance.uniform(0.02, 0.55))]))
        if anything and chance.random() < 0.05:
            parts.append(message(MODE, [chance.choice([OFF, MANUAL, AUTOMATIC])]))
        present = HAS_LEVEL | HAS_SAMPLE_COUNT | HAS_TICKS
        density = []
        if mode != "law":
            present |= HAS_APPLIED_FLUX | HAS_OUTLET_FLUX | HAS_DENSITY
        if anything and chance.random() < 0.2:
            present &= chance.getrandbits(6)
        elif mode != "law" and chance.random() < 0.3:
            present &= ~HAS_DENSITY
        if present & HAS_DENSITY:
            density = [chance.uniform(0.0, 2.0) for _ in range(places)]
            if anything and chance.random() < 0.2:
                density[chance.randrange(places)] = garbage(chance)
        ticks = 1
        if mode == "late":
            ticks = chance.choice([1, 2, 10, 50, 99, 100, 101, 1000])
        elif anything and chance.random() < 0.05:
            ticks = 0
        fluxes = [chance.uniform(0.0, 2.0), chance.uniform(0.0, 2.0)]
        shown = level
        if anything and chance.random() < 0.2:
            shown, fluxes = garbage(chance), [garbage(chance), garbage(chance)]
        sample += 0 if anything and chance.random() < 0.1 else 1
        parts.append(step(shown, *fluxes, sample, ticks, density, present))
    return b"".join(parts)


def period_of(stream):
    """The period that its first configuration states."""
    _, words = next(messages(stream))
    return struct.unpack("<f", struct.pack("<I", words[REALS.index("period")]))[0]


def steps_in(stream):
    return sum(what == STEP for what, _ in messages(stream))
