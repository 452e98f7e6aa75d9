# SPDX-License-Identifier: MIT
"""The oracle: the closed-loop level without solving a partial differential equation.

Under the exact law the target system (non tar 1)-(non tar 3) has w(D, t) = 0, and w = 0
everywhere from sigma(D, 0) on. From then on the level obeys the delay-free (Mp5),

    Q'(t) = alpha*u(Q*, Q) - service(Q),

whatever speed_window, rework, loss and processing time are. Before, prediction = future: Q passes
through p1(x, 0) at sigma(x, 0). A set-point change takes effect when the first material fed
under it arrives, at sigma(D, t). All of it holds while plant = model and U is not limited.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from reference.level_history import LevelHistory
from reference.line import Law, Line, profile
from reference.nominal_law import NominalLaw, nominal_law
from reference.predictor import predict


@dataclass(frozen=True)
class Piece:
    """The solution up to `end` [s]: state(t) = (Q [parts], integral of Q from 0 [parts s],
    distance the belt has moved since 0 [m])."""

    end: float
    state: Callable[[float], np.ndarray]


class Solution:
    """Pieces of the solution in ascending order, and its past before time 0."""

    def __init__(self, line: Line, initial_level: float) -> None:
        self.line = line
        self.initial_level = initial_level
        self.pieces: list[Piece] = []
        self.ends: list[float] = []

    def append(self, piece: Piece) -> None:
        self.pieces.append(piece)
        self.ends.append(piece.end)

    def __call__(self, time: float) -> np.ndarray:
        """(Q, integral of Q, distance) at a time within the pieces or before 0."""
        if time <= 0.0:
            return np.array([self.initial_level, self.initial_level * time, np.nan])
        piece = min(bisect_left(self.ends, time), len(self.pieces) - 1)
        return self.pieces[piece].state(time)


def first_transit(line: Line, initial_level: float, initial_density, node_count: int) -> Piece:
    """Up to sigma(D, 0): what the march at time 0 says of the material on the belt.

    Material at x arrives when the belt has moved by x, so the distance at sigma(x, 0) is x.
    The error is the march's: second order in the node spacing, below 1e-7 at 2000 nodes.
    """
    pieces = max(np.size(initial_density) - 1, 1)
    count = pieces * -(-node_count // pieces)
    positions = np.linspace(0.0, line.belt_length, count + 1)
    densities = profile(initial_density, line.belt_length, positions)
    history = LevelHistory.constant(line.speed_window, 0.0, initial_level)
    result = predict(line, positions, densities, history)
    level, speed = result.predicted_level, 1.0 / result.slowness
    service = np.array([line.service(value) for value in level])
    drift = line.connectivity * result.outlet_density * speed - service
    levels = CubicHermiteSpline(result.arrival_time, level, drift)
    distances = CubicHermiteSpline(result.arrival_time, positions, speed)
    integrals = levels.antiderivative()
    end = float(result.arrival_time[-1])
    return Piece(end, lambda time: np.array([levels(time), integrals(time), distances(time)]))


def delay_free(line: Line, law: NominalLaw, solution: Solution, start: float):
    """Right side of (Mp5) with the belt's distance alongside; speed from the recorded past.

    Valid for one speed_window from `start`: until then the window begins in the past.
    """

    def derivative(time: float, state: np.ndarray) -> list[float]:
        level, integral, _ = state
        left = min(time - line.speed_window, start)
        congestion = integral - solution(left)[1]
        drift = line.connectivity * law.flux(level) - line.service(level)
        return [drift, level, line.transport_speed(congestion)]

    return derivative


def go_on(line, law, solution: Solution, stop: float, threshold: float) -> bool:
    """Append the solution up to `stop` [s] or to where the distance meets the threshold [m].

    Returns whether it met the threshold. The tolerances are tight enough for the kinks of
    u and service, which the step control meets by refusing steps.
    """
    start = solution.ends[-1]

    def arrival(_time: float, state: np.ndarray) -> float:
        return state[2] - threshold

    arrival.terminal = True
    answer = solve_ivp(
        delay_free(line, law, solution, start),
        (start, stop),
        solution(start),
        method="DOP853",
        rtol=1e-10,
        atol=1e-12,
        dense_output=True,
        events=arrival if np.isfinite(threshold) else None,
    )
    solution.append(Piece(float(answer.t[-1]), answer.sol))
    return answer.status == 1


def solve(line: Line, law: Law, duration: float, changes, initial_level, first: Piece) -> Solution:
    """The solution over [0, duration] by the method of steps, each at most a speed_window long.

    changes: (time [s], level_setpoint [parts]) in ascending order of time.
    """
    solution = Solution(line, initial_level)
    solution.append(first)
    active = nominal_law(line, law)
    fed = [change for change in changes if change[0] <= first.end]
    waiting = [(first.state(time)[2] + line.belt_length, level) for time, level in fed]
    coming = list(changes[len(fed) :])
    while solution.ends[-1] < duration:
        now = solution.ends[-1]
        stop = min(now + line.speed_window, duration, coming[0][0] if coming else np.inf)
        threshold = waiting[0][0] if waiting else np.inf
        if go_on(line, active, solution, stop, threshold):
            active = nominal_law(line, replace(law, level_setpoint=waiting.pop(0)[1]))
        elif coming and stop == coming[0][0]:
            waiting.append((solution(stop)[2] + line.belt_length, coming.pop(0)[1]))
    return solution


def level_of(
    line: Line,
    law: Law,
    times,
    setpoint_times=(),
    setpoint_levels=(),
    initial_level: float = 0.0,
    initial_density=0.0,
    period: float = 0.0,
    node_count: int = 2000,
) -> np.ndarray:
    """The exact closed-loop level [parts] at the times [s]; same shape.

    initial_level held for a whole window before 0; initial_density [parts/m] a number or values
    equally spaced from outlet to inlet. With a period [s] > 0 the command is held, and a set-point
    change is fed from the first period that starts at or after its time.
    Error: that of the march over the material on the belt at time 0 (none for an empty belt and
    buffer), else 1e-9.
    """
    times = np.asarray(times, dtype=float)
    starts = [float(time) for time in setpoint_times]
    if period > 0.0:
        starts = [float(np.ceil(time / period - 1e-9)) * period for time in starts]
    changes = list(zip(starts, setpoint_levels, strict=True))
    first = first_transit(line, initial_level, initial_density, node_count)
    solution = solve(line, law, float(times.max()), changes, initial_level, first)
    return np.array([solution(time)[0] for time in times.ravel()]).reshape(times.shape)
