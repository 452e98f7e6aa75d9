# SPDX-License-Identifier: MIT
"""What the firmware's headers refuse to be compiled with."""

import subprocess
from pathlib import Path

import pytest

FIRMWARE = Path(__file__).resolve().parents[2] / "firmware"


def compile_header(*options):
    """The compiler's answer to a source that does nothing but include the front door."""
    return subprocess.run(
        ["cc", "-std=c99", "-fsyntax-only", f"-I{FIRMWARE}", *options, "-xc", "-"],
        input='#include "belt/belt.h"\n',
        capture_output=True,
        text=True,
    )


def test_front_door_compiles_by_itself():
    assert compile_header("-Wall", "-Wextra", "-Wpedantic", "-Werror").returncode == 0


@pytest.mark.parametrize(
    "option, message",
    [
        ("-ffast-math", "-ffast-math removes the checks for NaN"),
        ("-ffinite-math-only", "-ffinite-math-only removes the checks for NaN"),
        ("-funsafe-math-optimizations", "-funsafe-math-optimizations and its parts"),
        ("-DBELT_NODE_CAPACITY=3", "BELT_NODE_CAPACITY must lie in"),
        ("-DBELT_NODE_CAPACITY=1025", "BELT_NODE_CAPACITY must lie in"),
        ("-DBELT_WINDOW_CAPACITY=3", "BELT_WINDOW_CAPACITY must lie in"),
        ("-DBELT_WINDOW_CAPACITY=16385", "BELT_WINDOW_CAPACITY must lie in"),
        ("-DBELT_LOSS_CAPACITY=0", "BELT_LOSS_CAPACITY must lie in"),
    ],
)
def test_senseless_build_is_refused_with_its_reason(option, message):
    answer = compile_header(option)
    assert answer.returncode != 0
    assert message in answer.stderr
