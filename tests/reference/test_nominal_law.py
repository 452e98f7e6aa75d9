# SPDX-License-Identifier: MIT
"""Claims about the delay-free law: gains, branches, what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reference.line import Law, Line
from reference.nominal_law import NominalLaw, gain, nominal_law, setpoint_slope_min

LEVELS = np.linspace(0.0, 1.0, 401)


def test_paper_gains():
    law = nominal_law(Line(), Law())
    assert setpoint_slope_min(Line(), Law()) == pytest.approx(2.0, rel=1e-14)
    # 22/0.6 up to the small exp(-gain*width) = 1.7e-5 and 7e-12 of the two branches
    assert law.gain_below == pytest.approx(36.667, abs=1e-3)
    assert law.gain_above == pytest.approx(36.667, abs=1e-3)


def test_both_gains_satisfy_their_equations():
    law = nominal_law(Line(), Law(level_setpoint=0.45))
    below = law.gain_below * (1.2 - 0.9) - law.setpoint_slope * (1 - np.exp(-law.gain_below * 0.45))
    above = law.gain_above * 0.9 - law.setpoint_slope * (1 - np.exp(-law.gain_above * 0.55))
    assert abs(below) < 1e-11 and abs(above) < 1e-11  # rounding of terms of size 20


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.floats(0.02, 0.58), st.floats(1e-3, 100.0))
def test_the_branches_share_value_and_slope_at_the_setpoint(level_setpoint, slope_margin):
    law = nominal_law(Line(), Law(level_setpoint=level_setpoint, slope_margin=slope_margin))
    step = 1e-4 / max(law.gain_below, law.gain_above)
    for branch in (law.branch_below, law.branch_above):
        assert branch(level_setpoint) == pytest.approx(law.hold_flux, rel=1e-14)
        slope = (branch(level_setpoint + step) - branch(level_setpoint - step)) / (2 * step)
        # the difference quotient cancels eleven digits at the worst
        assert slope == pytest.approx(-law.setpoint_slope, rel=1e-6)


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.floats(0.02, 0.58), st.floats(1e-3, 100.0))
def test_flux_falls_with_the_level_from_its_maximum_to_zero(level_setpoint, slope_margin):
    law = nominal_law(Line(), Law(level_setpoint=level_setpoint, slope_margin=slope_margin))
    flux = np.array([law.flux(level) for level in LEVELS])
    assert flux[0] == pytest.approx(1.2, rel=1e-13)
    assert flux[-1] == pytest.approx(0.0, abs=1e-13)
    assert np.all(np.diff(flux) <= 1e-13)  # rounding on the flat parts


def test_one_branch_takes_the_point_at_the_setpoint():
    assert nominal_law(Line(), Law()).flux(0.3) == pytest.approx(0.6, rel=1e-14)


def test_levels_outside_count_as_the_nearer_end():
    law = nominal_law(Line(), Law())
    assert law.flux(-0.5) == law.flux(0.0) and law.flux(7.0) == law.flux(1.0)
    assert law.branch_below(-0.1) > 1.2 and law.branch_above(1.1) < 0.0


def test_the_left_branch_has_no_upward_authority_from_setpoint_06_on():
    """The paper admits every set-point up to min(Qmax, mu) = 0.8."""
    flat = NominalLaw(0.6, 1.0, 1.2, 1.2, 22.0, 36.0, 36.0)
    inverted = NominalLaw(0.7, 1.0, 1.4, 1.2, 22.0, 36.0, 36.0)
    assert flat.branch_below(0.0) == flat.branch_below(0.6)
    assert inverted.branch_below(0.0) < inverted.branch_below(0.7)


@pytest.mark.parametrize("level_setpoint", [0.0, -0.1, 0.6, 0.7, 0.8, 1.0, np.nan])
def test_setpoints_without_authority_are_refused(level_setpoint):
    with pytest.raises(ValueError, match="level_setpoint"):
        nominal_law(Line(), Law(level_setpoint=level_setpoint))


def test_slope_at_its_minimum_has_no_positive_gain_and_is_refused():
    with pytest.raises(ValueError, match="no positive gain"):
        nominal_law(Line(), Law(slope_margin=0.0))
    assert nominal_law(Line(), Law(slope_margin=1e-6)).gain_below > 0.0


def test_gain_close_to_its_minimum_follows_the_series():
    # slope*width = rise*(1 + e): Lambda*width = 2e - 2/3*e^2 + ..., from exp's series
    assert gain(2.0 * (1 + 1e-4), 0.6, 0.3) == pytest.approx(2e-4 / 0.3, rel=1e-4)


def test_flux_above_what_is_served_is_refused():
    with pytest.raises(ValueError, match="nominal_flux_max"):
        nominal_law(Line(), Law(nominal_flux_max=1.7))


def test_level_that_is_no_number_is_refused():
    with pytest.raises(ValueError, match="not finite"):
        nominal_law(Line(), Law()).flux(np.nan)


@pytest.mark.parametrize(("name", "value"), [("belt_length", 0.0), ("rework_rate", -1.0)])
def test_impossible_lines_are_refused(name, value):
    with pytest.raises(ValueError, match=name):
        replace(Line(), **{name: value})


@pytest.mark.parametrize("loss_rate", [(), (1.0, np.nan), (1.0, -np.inf)])
def test_impossible_loss_profiles_are_refused(loss_rate):
    with pytest.raises(ValueError, match="loss_rate"):
        Line(loss_rate=loss_rate)


def test_the_law_does_not_depend_on_the_units():
    parts, seconds = 300.0, 60.0  # the same line in other units of parts and time
    line = Line(service_time=seconds, service_rate_max=0.8 * parts / seconds, level_capacity=parts)
    law = Law(0.3 * parts, 1.2 * parts / seconds, slope_margin=20.0 / seconds)
    here, there = nominal_law(Line(), Law()), nominal_law(line, law)
    for level in LEVELS[::40]:
        expected = here.flux(level) * parts / seconds
        assert there.flux(level * parts) == pytest.approx(expected, rel=1e-11, abs=1e-10)
