# SPDX-License-Identifier: MIT
"""Rewrites the golden trajectories: python -m reference.trajectories [NAME ...].

Each is the closed loop in continuous time (closed_loop.py) over 10 s, a row every 20 ms. Values
carry 7 decimals: far coarser than what processors and BLAS differ by, so a rewrite is the same
byte for byte, and finer than the error of the solver.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from reference.closed_loop import COLUMNS, Run, simulate
from reference.line import Law, Line

FOLDER = Path(__file__).parent / "trajectories"
ROW_SPACING = 0.02


@dataclass(frozen=True)
class Case:
    """One trajectory: the line, the law and the run; the defaults are the paper's."""

    line: Line = field(default_factory=Line)
    law: Law = field(default_factory=Law)
    run: Run = field(default_factory=Run)


CASES = {
    "paper": Case(),
    "heavy_window": Case(line=Line(speed_window=3.0)),
    "lossy_profile": Case(line=Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5))),
    "setpoint_steps": Case(
        run=Run(setpoint_times=(3.0, 5.0, 8.0), setpoint_levels=(0.45, 0.30, 0.25))
    ),
    "loaded_line": Case(run=Run(initial_level=0.2, initial_density=(0.1, 0.3, 0.2))),
}


def text(case: Case) -> str:
    """The trajectory as CSV, LF line ends."""
    trace = simulate(case.line, case.law, case.run)
    rows = np.round(trace["time"] / ROW_SPACING, 9)
    chosen = rows == np.round(rows)
    lines = [",".join(COLUMNS)]
    for values in zip(*(trace[name][chosen] for name in COLUMNS), strict=True):
        lines.append(",".join(f"{value:z.7f}" for value in values))
    return "\n".join(lines) + "\n"


def main(names: list[str]) -> int:
    """Write the named trajectories, or all; returns the exit code."""
    unknown = [name for name in names if name not in CASES]
    if unknown:
        print(f"no trajectory {unknown[0]!r}; there are {', '.join(CASES)}", file=sys.stderr)
        return 2
    FOLDER.mkdir(exist_ok=True)
    for name in names or CASES:
        written = FOLDER / f"{name}.csv.new"
        written.write_bytes(text(CASES[name]).encode("ascii"))
        written.replace(FOLDER / f"{name}.csv")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
