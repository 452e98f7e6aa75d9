# SPDX-License-Identifier: MIT
"""What a controller is told when its cost is measured: recorded runs, and made-up inputs."""

import functools
import random
import tempfile
from pathlib import Path

import board
import stimuli

MODES = ["law", "full", "profile", "late"]
WINDOW_CAPACITY = 402  # that of types.h
SEED = 20
KEPT = board.ROOT / "tests" / "target" / "worst"

ALL_ON = [
    "controller.estimator=on",
    "controller.outlet_flux=measured",
    "controller.density=measured",
    "plant.level_noise=0.001",
]
LAW_RUNS = [
    ["paper"],
    ["setpoint_steps"],
    ["loaded_line"],
    ["paper", "--set", "line.speed_window=0.9"],
    ["paper", "--set", "line.rework_rate=0"],
]
PROFILE_RUNS = [["lossy_profile"], ["lossy_profile", "--set", "line.speed_window=0.9"]]
LATE_RUNS = [["lossy_profile", "--fault", "period:intermittent=0.9@1+2"]]
WINDOW = {"heavy_window": 0.9}  # s: as much as the capacity holds


def belongs(step, mode):
    """Whether a step of a stimulus made for a mode is one of that mode."""
    if mode == "law":
        return step.is_good_automatic()
    return step.is_late() == (mode == "late")


@functools.cache
def record(pc, *arguments):
    """What a run of the simulator tells its controller."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        code, message = board.simulate(
            pc.folder / "belt_sim_remote",
            pc.command("belt_server"),
            folder,
            [*arguments, "--summary", str(folder / "summary.json")],
        )
        if code != 0:
            raise board.Failure(f"{' '.join(arguments)}: exit code {code}\n{message}")
        return (folder / "requests").read_bytes()


def runs_of(pc, mode):
    """The runs of a mode, as arguments for the simulator."""
    if mode == "law":
        return LAW_RUNS
    runs = PROFILE_RUNS
    if mode == "late":
        runs = LATE_RUNS
    elif mode == "full":
        runs = [[name] for name in board.shipped(pc) if name != "lossy_profile"]
    settings = [word for setting in ALL_ON for word in ("--set", setting)]
    found = []
    for run in runs:
        fits = WINDOW.get(run[0])
        found.append([*run, *settings, *(["--set", f"line.speed_window={fits}"] if fits else [])])
    return found


def recordings(pc, node_count, mode):
    nodes = ["--set", f"controller.node_count={node_count}"]
    return [record(pc, *run, *nodes) for run in runs_of(pc, mode)]


def search(count_steps, mode, node_count, effort):
    """Made-up stimuli, the costliest kept and changed; returns them, the costliest first."""
    rounds, size = effort
    chance = random.Random(f"{SEED} {mode} {node_count}")
    family = []
    for _ in range(rounds):
        children = [stimuli.change(chance, genes, mode) for _, genes in family]
        while len(children) < size:
            children.append(stimuli.choose(chance, mode, node_count, WINDOW_CAPACITY))
        best = [0] * len(children)
        for step in count_steps([stimuli.grow(genes, mode) for genes in children]):
            if belongs(step, mode):
                best[step.stimulus] = max(best[step.stimulus], step.instructions)
        family += zip(best, children)
        family = sorted(family, key=lambda found: -found[0])[: size // 2]
    return [stimuli.grow(genes, mode) for count, genes in family if count > 0]


def cut(stream, index):
    """A stimulus up to and with its step of that index."""
    kept, steps = [], 0
    for what, words in stimuli.messages(stream):
        kept.append(stimuli.message(what, words))
        steps += what == stimuli.STEP
        if steps > index:
            break
    return b"".join(kept)


def kept_name(target, node_count, mode):
    return f"{target}_{node_count}_{mode}.requests"


def kept(target, node_count, mode):
    """The worst input that an earlier search has found, if it was kept."""
    path = KEPT / kept_name(target, node_count, mode)
    return [path.read_bytes()] if path.is_file() else []
