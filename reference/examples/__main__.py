# SPDX-License-Identifier: MIT
"""python -m reference.examples [NAME ...]: each worked system, measured against the theorems.

shift     sup over time of X minus the shift theorem, at the default resolution
late      sup of |X - rest| over the last quarter, compensated and with the nominal law alone
w left    sup of w from sigma(D, 0) on over sup of w at the start, at five instants: on the nodes
          of the run, and on three times as many by a spline of the belt (finer), there with the
          leading error taken off by a run on half the nodes, as in `shift`
inverse   sup of u minus the inverse of the forward transformation of u, at those instants
seconds   the run that `shift` measures
"""

import sys
from importlib import import_module
from time import perf_counter

import numpy as np
from scipy.interpolate import CubicSpline

from reference.examples import Example
from reference.integral_equations import Nodes, forward, inverse
from reference.mixed_loop import (
    NODE_COUNT,
    Trace,
    Uncompensated,
    simulate,
    simulate_extrapolated,
)
from reference.record import Record
from reference.target import state_of

NAMES = ("unstable_scalar", "pendulum", "nonlinear_recycle", "conveyor")
HEADER = "system              shift    late     nominal  w left   finer    inverse  seconds"


def at(trace: Trace, row: int, example: Example):
    """(nodes, u, record) at a row of a run."""
    positions, values = trace.belts[row]
    count = trace.record.count - len(trace.time) + 1 + row
    times, states = trace.record.times[:count], trace.record.states[:, :count]
    return Nodes(positions), values, Record(example.system.speed_window, times, states)


def arrived(trace: Trace) -> int:
    """The row of sigma(D, 0): the first belt has left, its jump with it."""
    return int(np.argmin(np.diff(trace.distance))) + 1


def elsewhere(trace: Trace, row: int, example: Example, pieces: int) -> np.ndarray:
    """w at a row on nodes that are not the run's; (pieces + 1,)."""
    nodes, values, past = at(trace, row, example)
    finer = Nodes(np.linspace(0.0, nodes.positions[-1], pieces + 1))
    between = CubicSpline(nodes.positions, values)(finer.positions)
    return forward(example.system, finer, between, past)


def measured(example: Example) -> list[float]:
    """The columns above."""
    system = example.system
    start = system, example.history, example.profile, example.duration
    begin = perf_counter()
    trace = simulate_extrapolated(*start)
    seconds = perf_counter() - begin
    exact = state_of(*start[:3], trace.time)
    plain = simulate(*start, keep_belts=True)
    rough = simulate(*start, NODE_COUNT // 2, keep_belts=True)
    bare = simulate(*start, law=Uncompensated(system))

    def late(run) -> float:
        away = np.abs(run.state - np.array(example.rest)[:, None])
        return np.max(away[:, run.time > 0.75 * example.duration])

    nodes, values, past = at(plain, 0, example)
    scale = np.max(np.abs(forward(system, nodes, values, past)))
    first = arrived(rough)
    left = []
    for row in np.linspace(first, len(rough.time) - 2, 5).astype(int):
        again = arrived(plain) + 2 * (row - first)  # the same distance on twice the nodes
        nodes, values, past = at(plain, again, example)
        target = forward(system, nodes, values, past)
        back = inverse(system, nodes, target, past)
        fine = elsewhere(plain, again, example, 3 * NODE_COUNT)[::2]
        coarse = elsewhere(rough, row, example, 3 * NODE_COUNT // 2)
        parts = target / scale, (4.0 * fine - coarse) / 3.0 / scale, back - values
        left.append([np.max(np.abs(part)) for part in parts])
    left = np.max(left, axis=0)
    shift = np.max(np.abs(trace.state - exact))
    return [shift, late(trace), late(bare), *left, seconds]


def main(names: list[str]) -> int:
    """Print a line for each named system, or all; returns the exit code."""
    unknown = [name for name in names if name not in NAMES]
    if unknown:
        print(f"no example {unknown[0]!r}; there are {', '.join(NAMES)}", file=sys.stderr)
        return 2
    print(HEADER)
    for name in names or NAMES:
        columns = measured(import_module(f"reference.examples.{name}").EXAMPLE)
        print(f"{name:19}", *(f"{value:<8.1e}" for value in columns[:-1]), f"{columns[-1]:.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
