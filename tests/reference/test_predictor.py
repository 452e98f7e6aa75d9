# SPDX-License-Identifier: MIT
"""Claims about the march (MF1)-(MF7)."""

import numpy as np
import pytest

from reference.level_history import LevelHistory
from reference.line import Law, Line
from reference.nominal_law import nominal_law
from reference.predictor import inlet_flux, kernel, predict

SMITH = Line(congestion_scale=1e15, rework_rate=0.0, loss_rate=(0.0,))
PROFILE = Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5))


def belt(line, node_count):
    """A belt with a jump in the middle; positions twice there, outlet side first."""
    half = line.belt_length / 2
    positions = np.concatenate(
        [
            np.linspace(0, half, node_count // 2 + 1),
            np.linspace(half, 2 * half, node_count // 2 + 1),
        ]
    )
    densities = 0.2 + 0.1 * np.sin(3.0 * positions)
    densities[node_count // 2 + 1 :] += 0.3
    return positions, densities


def history(line, level=0.2):
    return LevelHistory.constant(line.speed_window, 0.0, level)


def test_constant_speed_without_sources_is_the_smith_predictor():
    positions = np.linspace(0.0, 2.0, 401)
    densities = 0.1 + 0.05 * positions
    result = predict(SMITH, positions, densities, history(SMITH))
    assert result.outlet_density == pytest.approx(densities, rel=1e-14)
    assert result.arrival_time == pytest.approx(0.25 * positions, abs=1e-13)
    assert result.survival == pytest.approx(np.ones(401), rel=1e-15)
    # Q' = alpha*speed*(0.1 + 0.05*speed*t) - Q has Q = a + b*t + (Q(0) - a)*exp(-t)
    rise = 0.5 * 4.0 * 0.05 * 4.0
    start = 0.5 * 4.0 * 0.1 - rise
    time = 0.25 * positions
    level = start + rise * time + (0.2 - start) * np.exp(-time)
    # trapezoid: spacing^2/12 * derivative = 1.25e-3^2/12 in time, times 0.5 s
    assert np.max(np.abs(result.predicted_level - level)) < 1e-7


def test_smith_predictor_feeds_the_nominal_flux_of_the_predicted_level():
    positions, densities = belt(SMITH, 100)
    law = nominal_law(SMITH, Law())
    flux, result = inlet_flux(SMITH, law, positions, densities, history(SMITH))
    assert flux == pytest.approx(law.flux(result.predicted_level[-1]), rel=1e-9)


def test_no_material_lets_the_level_decay():
    line = Line()
    result = predict(line, np.linspace(0, 2, 201), np.zeros(201), history(line))
    level = 0.2 * np.exp(-result.arrival_time)
    # trapezoid over 0.5 s in steps of 2.5 ms: 0.2*0.5*0.0025^2/12 = 5e-8
    assert np.max(np.abs(result.predicted_level - level)) < 1e-7


def test_survival_of_a_uniform_loss_depends_on_the_transit_alone():
    line = Line(rework_rate=0.0)
    positions, densities = belt(line, 100)
    result = predict(line, positions, densities, history(line))
    expected = np.exp(-result.arrival_time)  # K(x, x) = exp(-C*(sigma - t)), C = 1
    # the node's slowness is corrected once after its survival: O(dx^3), 3e-10 measured
    assert result.survival == pytest.approx(expected, rel=1e-8)
    assert result.outlet_density == pytest.approx(expected * densities, rel=1e-8)


def test_kernel_of_a_uniform_loss_depends_on_y_alone():
    line = Line()
    result = predict(line, *belt(line, 60), history(line))
    values = kernel(line, result)
    expected = np.exp(-result.arrival_time)
    assert values[-1] == pytest.approx(expected, rel=1e-12)
    assert np.diag(values) == pytest.approx(result.survival, rel=1e-8)  # as above
    assert np.isnan(values[0, 1:]).all()


def test_survival_of_a_profile_at_constant_speed_is_the_integral_along_the_way():
    line = Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5), congestion_scale=1e15)
    result = predict(line, np.linspace(0, 2, 201), np.ones(201), history(line))
    # the profile's mean over the belt is 1.1625 1/s, the transit 0.5 s; knots lie on nodes
    assert result.survival[-1] == pytest.approx(np.exp(-0.5 * 1.1625), rel=1e-12)


def test_window_that_slid_past_now_uses_predicted_levels_only():
    line = Line()
    result = predict(line, *belt(line, 200), history(line))
    last = result.arrival_time[-1]
    assert last - line.speed_window > 0.0  # the window has slid past now
    times = np.append(last - line.speed_window, result.arrival_time)
    levels = np.interp(times, result.arrival_time, result.predicted_level)
    inside = np.sort(times[times >= last - line.speed_window])
    expected = np.trapezoid(np.interp(inside, result.arrival_time, result.predicted_level), inside)
    assert levels.size == times.size
    assert result.congestion[-1] == pytest.approx(expected, rel=1e-12)


def test_at_the_outlet_the_prediction_is_the_present():
    line = Line()
    result = predict(line, *belt(line, 20), history(line))
    assert result.predicted_level[0] == 0.2 and result.arrival_time[0] == 0.0
    assert result.congestion[0] == pytest.approx(0.04, rel=1e-14)


@pytest.mark.parametrize("line", [Line(), PROFILE, Line(speed_window=3.0, rework_rate=0.3)])
def test_the_flux_fed_makes_the_target_system_vanish_at_the_inlet(line):
    """w(D, t) = 0: with U on the belt the march finds p2 = kappa(p1)/lambda(p3) there."""
    law = nominal_law(line, Law())
    positions, densities = belt(line, 100)
    positions, densities = positions[:-1], densities[:-1]
    flux, planned = inlet_flux(line, law, positions, densities, history(line))
    densities = np.append(densities, flux * planned.slowness[0])
    result = predict(line, np.append(positions, line.belt_length), densities, history(line))
    demanded = law.flux(result.predicted_level[-1]) * result.slowness[-1]
    # the belt made up here does not go on smoothly into what the law demands: the slowness, which
    # is corrected once, is O(dx^2) off at this node, 3e-6 measured
    assert result.outlet_density[-1] == pytest.approx(demanded, rel=1e-5)


@pytest.mark.parametrize("line", [Line(), PROFILE, Line(speed_window=3.0, rework_rate=0.3)])
def test_march_is_second_order_across_a_jump(line):
    def answer(node_count):
        result = predict(line, *belt(line, node_count), history(line))
        return np.array([result.predicted_level[-1], result.outlet_density[-1], result.rework[-1]])

    exact = answer(1280)
    coarse, fine = np.abs(answer(40) - exact), np.abs(answer(80) - exact)
    assert np.all(coarse / fine > 3.5)  # 4 for second order, 2 for first
    assert np.all(fine < 1e-4)


def test_prediction_does_not_depend_on_when_it_is_made():
    line = Line()
    late = LevelHistory.constant(line.speed_window, 1000.0, 0.2)
    early_result = predict(line, *belt(line, 40), history(line))
    late_result = predict(line, *belt(line, 40), late)
    # a clock at 1000 s carries 1e-13 s
    assert late_result.predicted_level == pytest.approx(early_result.predicted_level, abs=1e-12)
    assert late_result.arrival_time - 1000.0 == pytest.approx(early_result.arrival_time, abs=1e-11)


def test_congestion_of_a_window_shorter_than_a_step_is_linear_interpolation():
    record = LevelHistory(0.1, [0.0, 1.0], [0.5, 0.5])
    # over the last 0.1 s of a rise from 0.5 to 1.5 within 1 s the mean level is 1.45
    assert record.congestion_if(2.0, 1.5) == pytest.approx(0.145, rel=1e-13)
