# SPDX-License-Identifier: MIT
"""Runs of belt_sim as numbers, each made once, and how a figure is held against its limit."""

import json
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from reference.line import Law, Line
from reference.shift_theorem import level_of
from tests.system.command import belt_sim

# What the shipped scenarios say of the line, in the reference's words.
LOSS_PROFILE = (0.4, 1.2, 2.0, 1.0, 0.5)
LOADED = {"initial_level": 0.2, "initial_density": (0.1, 0.3, 0.2)}
LINES = {
    "paper": Line(),
    "heavy_window": Line(speed_window=3.0),
    "lossy_profile": Line(loss_rate=LOSS_PROFILE),
    "loaded_line": Line(),
    "setpoint_steps": Line(),
}
PERIOD = 0.0025  # s, of every run unless it says otherwise


@dataclass(frozen=True)
class Run:
    """trace: an array for each column; summary: the figures of belt_sim."""

    trace: dict
    summary: dict

    def __getitem__(self, column):
        return self.trace[column]


@cache
def run(scenario, *settings, program="BELT_SIM"):
    """One run with `section.key=value` settings; made once for each set of arguments."""
    words = [word for setting in settings for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "trace.csv")
        result = belt_sim("run", scenario, *words, "--trace", path, program=program)
        assert result.returncode == 0, result.stderr
        rows = np.genfromtxt(path, delimiter=",", names=True)
    return Run({name: rows[name] for name in rows.dtype.names}, json.loads(result.stdout))


def shift_error(found, line=None, law=None, **more):
    """buffer_level less what the shift theorem says of it, at every row [parts]."""
    times = found["time"]
    return found["buffer_level"] - level_of(line or Line(), law or Law(), times, **more)


def greatest(values):
    return float(np.max(np.abs(values)))


def hold(name, figure, limit):
    """Prints the figure (pytest -rP shows it) and asserts its limit."""
    print(f"{name}: {figure:.3g}, limit {limit:.3g}")
    assert figure <= limit, f"{name}: {figure:.6g} is above {limit:.3g}"
