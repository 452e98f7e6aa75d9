# SPDX-License-Identifier: MIT
"""A coarse safety map: no promise is broken, in runs of the reference and of the controller."""

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from pathlib import Path

import numpy as np
import pytest

from reference.line import Law, Line
from tests.system.runs import run
from tests.system.test_safety import check, settings_of, start

TOOL = Path(__file__).resolve().parents[2] / "tools" / "safety_map"


@pytest.fixture(scope="module")
def tool():
    loader = SourceFileLoader("safety_map", str(TOOL))
    module = module_from_spec(spec_from_loader("safety_map", loader))
    loader.exec_module(module)
    return module


@pytest.mark.parametrize("line", ["paper", "heavy_window"])
def test_promises_lie_inside_what_simulation_shows(tool, line):
    """The reference without limits; the map in docs/ has 28 by 14 places a picture."""
    counts = {}
    for view in tool.views(3):
        for y in view.ordinates:
            for rate in (0.01, 0.1, 0.4, 0.9, 1.5):
                place = tool.kind(tool.shown(view.case(tool.LINES[line], rate, y)))
                counts[place] = counts.get(place, 0) + 1
    assert counts.get(tool.BROKEN, 0) == 0
    # each kind of place is there: the map says something
    assert set(counts) == {tool.NEGATIVE, tool.POSITIVE, tool.SHARPER, tool.PROPOSITION}
    assert counts[tool.SHARPER] + counts[tool.PROPOSITION] > counts[tool.POSITIVE]


@pytest.mark.parametrize("window", [0.2, 3.0])
def test_what_check_promises_a_run_shows(window):
    """The controller itself, whose command is kept at 0 where the law asks for less."""
    kept, silent = 0, 0
    for rate in (0.02, 0.1, 0.4):
        for setpoint, level, density in ((0.1, 0.0, 0.0), (0.5, 0.0, 0.0), (0.3, 0.45, 0.3)):
            line = Line(speed_window=window, rework_rate=rate)
            settings = *settings_of(line, Law(setpoint)), *start(level, np.array([density]))
            promised = any(bound.holds for bound in check("paper", *settings)[:2])
            transit = 0.5 * (1.0 + setpoint * window)
            flux = run("paper", *settings, f"run.duration={5 * transit:g}")["inlet_flux"]
            assert not promised or np.min(flux) > 0.0, (rate, setpoint, level)
            kept += promised
            silent += not promised
    assert kept > silent > 0
