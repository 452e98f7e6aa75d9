# SPDX-License-Identifier: MIT
"""Any system of Section 2 or 3 in closed loop, by characteristics.

The nodes of the belt ride with the material, one spacing a step, so they always stand where the
predictor's nodes are and nothing is interpolated. Plant and predictor share the rule by which they
integrate: what the march foretells on these nodes is what the plant then does, to rounding, and
what is left against the exact solution is the rule's own error, second order in the spacing.
The law is computed anew from the state and the belt of every instant.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from reference.integral_equations import Nodes, Prediction, predict_with_law
from reference.record import Record
from reference.section2 import Characteristics

NODE_COUNT = 200  # pieces of the belt
PASSES = 60  # of an implicit step's fixed point, far more than it needs
TOLERANCE = 1e-15  # of its last pass, relative to the state


class Plant:
    """The system at one instant: record of X, positions [m] and values u of the belt's nodes.

    The first node is at 0, the last at D once it is fed.
    """

    def __init__(self, system, history, profile, node_count: int = NODE_COUNT) -> None:
        """At time 0: history h (a state, or a function of time on [-tau, 0]), profile u0 (a number
        or a function of position)."""
        self.system = system
        self.record = Record.of(system.speed_window, history)
        self.positions = np.linspace(0.0, system.belt_length, node_count + 1)
        values = profile(self.positions) if callable(profile) else profile
        self.values = np.broadcast_to(np.asarray(values, float), self.positions.shape).copy()
        self.distance = 0.0
        self.spacing = system.belt_length / node_count
        self.window = self.record.window()
        self.speed = float(np.squeeze(system.speed(self.window)))

    @property
    def time(self) -> float:
        return self.record.time

    @property
    def state(self) -> np.ndarray:
        """X(t) (n,)."""
        return self.record.state

    def feed(self, control: float) -> None:
        """Put a node at D that carries what `control` feeds: (boundary condition) or (M4)."""
        self.positions = np.append(self.positions, self.system.belt_length)
        fed = float(np.squeeze(self.system.inlet_value(control, self.speed)))
        self.values = np.append(self.values, fed)

    def advance(self) -> float:
        """Let the first node leave; returns the distance moved [m], 0 when a jump leaves.

        (equation X), (equation u) or (M1)-(M3) over one strip by the trapezoid rule, friction as
        an integrating factor. Raises ArithmeticError when the implicit step does not settle.
        """
        system, positions, values = self.system, self.positions, self.values
        present, now, speed = self.state.copy(), self.time, self.speed
        gap = float(positions[1])
        after = positions[1:] - gap
        friction = 0.5 * gap * np.asarray(system.friction(positions[1:]))
        friction_after = 0.5 * gap * np.asarray(system.friction(after))
        before = values[1:] + 0.5 * gap * system.source(positions[1:], values[0]) / speed
        drift = system.f(present, system.ode_input(speed, values[0])) / speed
        state, outlet, speed_after = present, values[1], speed
        for _ in range(PASSES):
            last = state, outlet
            time = now + 0.5 * gap * (1.0 / speed + 1.0 / speed_after)
            ahead = np.array([now, time]), np.stack([present, state], axis=1)
            window = self.record.window_ahead(*ahead)[:, -1]
            speed_after = float(np.squeeze(system.speed(window)))
            grown = np.exp(friction[0] / speed + friction_after[0] / speed_after)
            gained = 0.5 * gap * float(np.squeeze(system.source(0.0, outlet))) / speed_after
            outlet = grown * before[0] + gained
            end = system.f(state, system.ode_input(speed_after, outlet)) / speed_after
            state = present + 0.5 * gap * (drift + end)
            change = np.max(np.abs(state - last[0])) + abs(outlet - last[1])
            if change < TOLERANCE * (1.0 + np.max(np.abs(state)) + abs(outlet)):
                break
        else:
            raise ArithmeticError(f"the step at {now} s does not settle")
        grown = np.exp(friction / speed + friction_after / speed_after)
        self.values = grown * before + 0.5 * gap * system.source(after, outlet) / speed_after
        self.positions = after
        self.record.append(time, state)
        self.distance += gap
        self.window, self.speed = window, speed_after
        return gap


# ---- What is fed ----


class Compensated:
    """The predictor feedback (boundary control) or (MF1) of `model`, which may differ from the
    plant; each march starts from where the last one puts the material now."""

    def __init__(self, model) -> None:
        self.model = model
        self.prediction: Prediction | None = None
        self.positions = np.zeros(0)
        self.nodes: Nodes | None = None

    def __call__(self, plant: Plant) -> float:
        positions = np.append(plant.positions, self.model.belt_length)
        if self.nodes is None or not np.array_equal(positions, self.nodes.positions):
            self.nodes = Nodes(positions)
        guess = None
        if self.prediction is not None and self.prediction.state.shape[-1] == len(positions):
            guess = self.prediction.extended(len(positions) + 1).without_first()
        self.prediction = predict_with_law(
            self.model, self.nodes, plant.values, plant.record, guess
        )
        return self.model.control(self.nodes, self.prediction)


class Uncompensated:
    """The nominal law on the present state: U = kappa(X(t))."""

    def __init__(self, system) -> None:
        self.system = system

    def __call__(self, plant: Plant) -> float:
        return float(np.squeeze(self.system.kappa(plant.state)))


# ---- The run ----


@dataclass
class Trace:
    """One entry an instant, (K,) or (n, K); an instant stands twice where a jump leaves the belt.

    time [s], state X, control U, outlet u(0, t), window R, speed lambda(R) [m/s], distance xi [m];
    predicted: the Prediction at D of each instant, or None; belts: (positions, values) of each
    instant where asked for.
    """

    time: np.ndarray
    state: np.ndarray
    control: np.ndarray
    outlet: np.ndarray
    window: np.ndarray
    speed: np.ndarray
    distance: np.ndarray
    record: Record
    predicted: Prediction | None = None
    belts: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)

    def characteristics(self) -> Characteristics:
        """zeta, phi and sigma of the run."""
        return Characteristics(self.time, self.distance, self.speed)


def simulate(
    system,
    history,
    profile,
    duration: float,
    node_count: int = NODE_COUNT,
    law: Callable[[Plant], float] | None = None,
    keep_belts: bool = False,
) -> Trace:
    """The closed loop from time 0 until `duration` [s] or the step after it.

    history, profile as in Plant; law: Compensated(system) unless said, or any function of the
    plant that gives U. Raises ArithmeticError where a march or a step does not settle.
    """
    law = law or Compensated(system)
    plant = Plant(system, history, profile, node_count)
    control = law(plant)
    plant.feed(control)
    rows, ends, belts = [], [], []
    while True:
        row = plant.time, control, plant.values[0], plant.speed, plant.distance
        rows.append((*row, *plant.state, *plant.window))
        prediction = getattr(law, "prediction", None)
        if prediction is not None:
            ends.append([values[..., -1] for values in vars(prediction).values()])
        if keep_belts:
            belts.append((plant.positions, plant.values))
        if plant.time >= duration:
            break
        if plant.advance() > 0.0:
            control = law(plant)
            plant.feed(control)
        elif prediction is not None:
            law.prediction = prediction.without_first()
    return trace_of(rows, ends, belts, plant)


def simulate_extrapolated(
    system, history, profile, duration, node_count=NODE_COUNT, law=Compensated
):
    """The closed loop with its leading error taken off: the default way to run the reference.

    Runs at node_count and at half of it stand at the same distances xi, where their errors are as
    4 to 1: (4*fine - coarse)/3 of every column is of third order or better. The answer has an entry
    every other node, and no belts. law: a class that makes a law of the system.
    Raises ValueError for an odd node_count.
    """
    if node_count % 2:
        raise ValueError(f"node_count {node_count} is odd")
    fine = simulate(system, history, profile, duration, node_count, law(system))
    coarse = simulate(system, history, profile, duration, node_count // 2, law(system))
    return extrapolated(fine, coarse)


def extrapolated(fine: Trace, coarse: Trace) -> Trace:
    """The combination of two runs of which the first has twice the nodes."""
    # the jump of time 0 leaves at xi = D: its second row is one further on in both
    index = np.searchsorted(fine.distance, coarse.distance * (1.0 - 1e-12))
    index[1:] += np.diff(coarse.distance) == 0.0
    shared = index < len(fine.time)

    def combine(name: str, part: str | None = None):
        values, rough = getattr(fine, name), getattr(coarse, name)
        if part is not None:
            values, rough = getattr(values, part), getattr(rough, part)
        return (4.0 * values[..., index[shared]] - rough[..., shared]) / 3.0

    names = ("time", "state", "control", "outlet", "window", "speed", "distance")
    columns = dict(zip(names, map(combine, names), strict=True))
    predicted = None
    if fine.predicted is not None:
        parts = ("state", "outlet", "window", "arrival", "speed")
        predicted = Prediction(*(combine("predicted", part) for part in parts))
    record = fine.record
    before = record.times < 0.0
    times = np.concatenate([record.times[before], columns["time"]])
    states = np.concatenate([record.states[:, before], columns["state"]], axis=1)
    record = Record(record.speed_window, times, states)
    return Trace(**columns, record=record, predicted=predicted)


def trace_of(rows, ends, belts, plant: Plant) -> Trace:
    """The rows of a run as arrays."""
    values = np.array(rows).T
    size = len(plant.state)
    time, control, outlet, speed, distance = values[:5]
    predicted = None
    if ends:
        layers = zip(*ends, strict=True)
        predicted = Prediction(*(np.stack(layer, axis=-1) for layer in layers))
    state, window = values[5 : 5 + size], values[5 + size :]
    return Trace(
        time, state, control, outlet, window, speed, distance, plant.record, predicted, belts
    )
