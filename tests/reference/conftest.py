# SPDX-License-Identifier: MIT
"""Runs of the reference that several claims lean on, each made once."""

import pytest

from reference.closed_loop import Run, simulate
from reference.line import Law, Line


@pytest.fixture(scope="session")
def paper_run():
    """The paper's case over 2.5 s: start, transient and rest."""
    return simulate(Line(), Law(), Run(duration=2.5))


@pytest.fixture(scope="session")
def heavy_run():
    """The paper's case with a speed window of 3 s."""
    return simulate(Line(speed_window=3.0), Law(), Run(duration=2.5))
