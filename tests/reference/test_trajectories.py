# SPDX-License-Identifier: MIT
"""Claims about the golden trajectories and the program that compares traces with them."""

import subprocess
import sys
from pathlib import Path

import pytest

from reference.closed_loop import COLUMNS
from reference.trajectories import CASES, FOLDER, text

COMPARE = Path(__file__).resolve().parents[2] / "tools" / "compare"


def compare(*arguments):
    command = [sys.executable, COMPARE, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


@pytest.mark.parametrize("name", CASES)
def test_golden_trajectory_is_rewritten_byte_for_byte(name):
    assert (FOLDER / f"{name}.csv").read_bytes() == text(CASES[name]).encode("ascii")


def test_every_golden_trajectory_has_a_case():
    assert sorted(path.stem for path in FOLDER.glob("*.csv")) == sorted(CASES)


def trace(folder, change=None, period=0.0025):
    """A trace on a finer grid that follows the paper's golden run; change edits a row's dict."""
    rows = [line.split(",") for line in (FOLDER / "paper.csv").read_text().splitlines()[1:]]
    values = [dict(zip(COLUMNS, map(float, row), strict=True)) for row in rows]
    lines = [",".join([*COLUMNS, "mode"])]
    pieces = round(0.02 / period)
    for before, after in zip(values, [*values[1:], values[-1]], strict=True):
        for piece in range(pieces if before is not values[-1] else 1):
            share = piece / pieces
            row = {key: before[key] + share * (after[key] - before[key]) for key in COLUMNS}
            middle = share + 0.5 / pieces  # the command is aimed at the middle of its hold
            command = before["inlet_flux"]
            row["inlet_flux"] = command + middle * (after["inlet_flux"] - command)
            if change:
                change(row)
            lines.append(",".join([*(f"{row[key]:.17g}" for key in COLUMNS), "1"]))
    path = folder / "trace.csv"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_compare_finds_a_trace_that_follows_the_reference_equal(tmp_path):
    # a command interpolated across the kink at a reference row is off by its change of slope
    answer = compare(trace(tmp_path), FOLDER / "paper.csv", "--limit", "3e-4")
    assert answer.returncode == 0, answer.stdout


def test_compare_names_the_worst_offender(tmp_path):
    def change(row):
        row["survival"] += 0.01 if abs(row["time"] - 3.0) < 0.01 else 0.0

    answer = compare(trace(tmp_path, change), FOLDER / "paper.csv", "--limit", "1e-3")
    assert answer.returncode == 1
    assert "worst: survival at 3 s" in answer.stdout


def test_compare_leaves_a_jump_out_but_not_what_follows_it(tmp_path):
    def late_front(row):
        row["outlet_flux"] = 0.0 if row["time"] < 0.5024 else row["outlet_flux"]

    def lost_front(row):
        row["outlet_flux"] = 0.0 if row["time"] < 0.53 else row["outlet_flux"]

    reference = FOLDER / "paper.csv"
    assert compare(trace(tmp_path, late_front), reference, "--limit", "1e-3").returncode == 0
    assert compare(trace(tmp_path, lost_front), reference, "--limit", "1e-3").returncode == 1


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "fewer than two rows"),
        ("time,buffer_level\n", "fewer than two rows"),
        ("time,buffer_level\n0,0\n1,0\n", "no column level_setpoint"),
        ("buffer_level\n0\n1\n", "no column time"),
        ("time,buffer_level\n1,0\n0,0\n", "does not ascend"),
        ("time,buffer_level\n0,0\n1\n", "line 3 has 1 fields"),
    ],
)
def test_compare_refuses_bad_input_with_one_line(tmp_path, content, message):
    path = tmp_path / "trace.csv"
    path.write_text(content)
    answer = compare(path, FOLDER / "paper.csv")
    assert answer.returncode == 2
    assert message in answer.stderr and answer.stderr.count("\n") == 1


def test_compare_refuses_a_missing_file(tmp_path):
    answer = compare(tmp_path / "none.csv", FOLDER / "paper.csv")
    assert answer.returncode == 2 and answer.stderr.count("\n") == 1


def test_compare_refuses_a_trace_that_is_not_a_number_or_ends_early(tmp_path):
    def break_number(row):
        row["survival"] = float("nan") if row["time"] == 1.0 else row["survival"]

    path = trace(tmp_path, break_number)
    assert "not a number" in compare(path, FOLDER / "paper.csv").stderr
    lines = trace(tmp_path).read_text().splitlines()
    path.write_text("\n".join(lines[:-100]) + "\n")
    answer = compare(path, FOLDER / "paper.csv")
    assert answer.returncode == 2 and "ends at" in answer.stderr
