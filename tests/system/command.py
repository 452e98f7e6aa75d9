# SPDX-License-Identifier: MIT
"""How the tests start belt_sim. The build names the program in the environment: BELT_SIM."""

import os
import subprocess
from pathlib import Path

SCENARIOS = Path(__file__).resolve().parents[2] / "host_sim" / "scenarios"
SHIPPED = sorted(path.stem for path in SCENARIOS.glob("*.ini"))

# a run of 40 periods, for tests that are about files and not about figures
SHORT = ("--set", "run.duration=0.1")


def belt_sim(*arguments, program="BELT_SIM", **more):
    """Starts the program; bytes it wrote are text, its exit code is the caller's to judge."""
    command = [os.environ[program], *map(str, arguments)]
    return subprocess.run(command, **{"capture_output": True, "text": True, "timeout": 600, **more})


def assert_refused(result, *parts):
    """Exit 2, nothing on standard output, one line of message that holds each part."""
    assert result.returncode == 2, result.stderr
    assert result.stdout == ""
    assert result.stderr.count("\n") == 1 and result.stderr.endswith("\n"), result.stderr
    for part in parts:
        assert part in result.stderr


def names_in(folder):
    return sorted(path.name for path in folder.iterdir())
