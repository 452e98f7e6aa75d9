# SPDX-License-Identifier: MIT
"""Runs of the reference that several claims lean on, each made once."""

from dataclasses import dataclass
from functools import cache
from importlib import import_module

import pytest

from reference import mixed_loop
from reference.closed_loop import Run, simulate
from reference.examples import Example
from reference.examples.__main__ import NAMES
from reference.line import Law, Line


@pytest.fixture(scope="session")
def paper_run():
    """The paper's case over 2.5 s: start, transient and rest."""
    return simulate(Line(), Law(), Run(duration=2.5))


@pytest.fixture(scope="session")
def heavy_run():
    """The paper's case with a speed window of 3 s."""
    return simulate(Line(speed_window=3.0), Law(), Run(duration=2.5))


@dataclass(frozen=True)
class Worked:
    """A worked system with its runs: `fine` at the default resolution, `plain` on 100 nodes with
    every belt kept."""

    example: Example
    fine: mixed_loop.Trace
    plain: mixed_loop.Trace

    @property
    def start(self):
        return self.example.system, self.example.history, self.example.profile


@cache
def run_worked(name):
    example = import_module(f"reference.examples.{name}").EXAMPLE
    start = example.system, example.history, example.profile, example.duration
    fine = mixed_loop.simulate_extrapolated(*start)
    return Worked(example, fine, mixed_loop.simulate(*start, 100, keep_belts=True))


@pytest.fixture(params=NAMES)
def worked(request):
    """Each of the four worked systems in turn."""
    return run_worked(request.param)
