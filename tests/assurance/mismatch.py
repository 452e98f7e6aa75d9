# SPDX-License-Identifier: MIT
"""Random mismatch of plant and model, all numbers at once: python -m tests.assurance.mismatch

Runs belt_mismatch in pieces and keeps its rows in a file of state. A campaign that was ended, by
whatever, goes on where the file's last whole row ends; the file then is byte for byte the one of a
campaign that was not. Prints the shares and the worst cases.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

PIECE = 50  # cases a call
SWING = 1e-3  # moves by more in the last 5 s: oscillates [parts]
FACTORS = ["P", "D", "alpha", "C", "A", "tau", "mu"]
COLUMNS = ["index", *FACTORS, "final_error", "swing", "top", "spilled"]


def whole_rows(text, first=0):
    """The rows of `text` that are whole and follow each other from `first` on."""
    rows = []
    for line in text.splitlines(keepends=True):
        words = line.split()
        if not line.endswith("\n") or len(words) != len(COLUMNS):
            break
        if words[0] != str(first + len(rows)):
            break
        rows.append(line)
    return rows


def cases(line, count, seed, first=0, program=None):
    """Rows of belt_mismatch, as text."""
    command = [program or os.environ["BELT_MISMATCH"], line, count, seed, first]
    result = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if result.returncode != 0:
        raise SystemExit(f"mismatch: {' '.join(map(str, command))}: {result.stderr}")
    rows = whole_rows(result.stdout, first)
    assert len(rows) == count, f"{len(rows)} rows of {count}"
    return rows


def campaign(line, count, seed, state, program=None):
    """All rows, those that the file `state` holds already taken from it."""
    state = Path(state)
    rows = whole_rows(state.read_text() if state.exists() else "")[:count]
    with state.open("w") as file:
        file.writelines(rows)
        while len(rows) < count:
            piece = cases(line, min(PIECE, count - len(rows)), seed, len(rows), program)
            file.writelines(piece)
            file.flush()
            rows += piece
    return rows


def numbers(rows):
    return [dict(zip(COLUMNS, map(float, row.split()))) for row in rows]


def oscillating(found):
    """Share of some cases that oscillates."""
    return sum(case["swing"] > SWING for case in found) / max(len(found), 1)


def summary(rows):
    """What is published of a campaign."""
    found = numbers(rows)
    calm = [case for case in found if case["swing"] <= SWING]
    return {
        "cases": len(found),
        "oscillates": oscillating(found),
        # the dead time of the empty line is what the estimator's rule is made for
        "oscillates, P D within 20 %": oscillating(
            [case for case in found if 0.8 <= case["P"] * case["D"] <= 1.2]
        ),
        "final error of the calm, worst": max(case["final_error"] for case in calm),
        "swing, worst": max(case["swing"] for case in found),
        "level, greatest": max(case["top"] for case in found),
        "spilled": sum(case["spilled"] for case in found),
    }


def main(argv):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, help="belt_mismatch")
    parser.add_argument("--line", default="paper", help="the scenario: paper, heavy_window")
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=20200525)
    parser.add_argument("--state", type=Path, required=True, help="file to resume from")
    given = parser.parse_args(argv)
    rows = campaign(given.line, given.count, given.seed, given.state, given.program)
    for name, figure in summary(rows).items():
        print(f"{given.line}: {name}: {figure:.3g}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
