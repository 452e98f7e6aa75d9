# SPDX-License-Identifier: MIT
"""What the shipped scenarios with something wrong in them promise, against their opposites."""

import numpy as np
import pytest

from tests.system.faults import AUTOMATIC, MANUAL, MISMATCH, OFF
from tests.system.runs import PERIOD, greatest, hold, run

ESTIMATOR_OFF = "controller.estimator=off"


def at_rest(found, since):
    """Greatest distance of the level from its set-point from a time on [parts]."""
    late = found["time"] >= since
    return greatest((found["buffer_level"] - found["level_setpoint"])[late])


def test_mismatch_ends_at_the_set_point_and_without_estimator_beside_it():
    hold("left from 10 s on", at_rest(run("mismatch"), 10.0), 1e-3)
    assert at_rest(run("mismatch", ESTIMATOR_OFF), 10.0) > 0.03


def test_noise_stays_out_of_the_feeder_when_the_level_is_estimated():
    calm = run("noisy_sensor")
    raw = run("noisy_sensor", ESTIMATOR_OFF)
    variation = "inlet_flux_variation"
    hold("share of the variation", calm.summary[variation] / raw.summary[variation], 0.02)
    late = calm["time"] >= 5.0
    noise = (calm["level_measured"] - calm["buffer_level"])[late]
    # four standard deviations of a deviation over 6001 samples, the quantum's own included
    assert np.std(noise) == pytest.approx(np.hypot(0.005, 0.002 / np.sqrt(12)), rel=0.04)
    hold("left from 5 s on", at_rest(calm, 5.0), 3e-3)
    estimate = greatest((calm["level_estimate"] - calm["buffer_level"])[late])
    hold("error of the estimate", estimate, 3e-3)


def test_measured_levels_are_multiples_of_the_quantum():
    levels = run("noisy_sensor")["level_measured"] / 0.002
    # float32 numbers of size 150
    hold("off a multiple", greatest(levels - np.round(levels)), 2e-5)


def test_valve_that_is_too_small_delays_the_start_and_nothing_else():
    found = run("valve_limit")
    assert found["applied_flux"].max() == 1.2 < found["inlet_flux"].max()
    # what is applied in a period is the command of the row before, as far as the valve lets it
    assert np.array_equal(found["applied_flux"][1:], np.minimum(found["inlet_flux"][:-1], 1.2))
    hold("overshoot [share]", found.summary["overshoot"], 1e-3)
    hold("left at the end", abs(found.summary["final_error"]), 1e-5)
    assert found.summary["error_bits"] == MISMATCH
    # the observer rides on what was applied: as exact as in a run whose valve is large enough
    sound = run("paper")
    late = found["time"] >= 3.0
    error, usual = (greatest(each["observer_error"][late]) for each in (found, sound))
    hold("observer error [parts/m], less the sound run's", error - usual, 1e-3)


def test_operator_takes_over_and_hands_back_without_a_jump():
    found = run("operator")
    hold("greatest change a period", greatest(np.diff(found["inlet_flux"])), 20 * PERIOD * 1.00001)
    modes = found["mode"].astype(int)
    changes = [AUTOMATIC, *modes[1:][np.diff(modes) != 0]]
    assert changes == [AUTOMATIC, MANUAL, OFF, AUTOMATIC]
    manual = found["inlet_flux"][modes == MANUAL]
    before = found["inlet_flux"][found["time"] < 4.0 - PERIOD / 2][-1]
    assert manual[0] == pytest.approx(before, abs=1e-6)
    assert manual[np.searchsorted(found["time"][modes == MANUAL], 7.9)] == pytest.approx(1.1)
    assert found["inlet_flux"][modes == OFF][-1] == 0.0
    hold("left at the end", abs(found.summary["final_error"]), 1e-5)


def test_power_cut_leaves_a_gap_on_the_belt_that_is_known():
    found = run("power_cut")
    assert found.summary["steps"] == len(found["time"]) - 40
    assert found["applied_flux"][(found["time"] > 0.801) & (found["time"] < 0.901)].max() == 0.0
    hold("left at the end", abs(found.summary["final_error"]), 1e-5)
    hold("settling time [s]", found.summary["settling_time"], 1.7)


def test_jam_is_seen_fed_less_and_recovered_from():
    found = run("jam")
    blind = run("jam", ESTIMATOR_OFF)
    hold("peak [parts]", found.summary["level_peak"], blind.summary["level_peak"] - 0.04)
    at_end = (found["time"] > 9.5) & (found["time"] < 10.0)
    # what is held back: the service is 0.1 instead of the level over service_time
    held_back = (found["buffer_level"] - 0.1)[at_end]
    hold("disturbance, which lags", greatest(found["disturbance"][at_end] - held_back), 0.03)
    hold("left from 18 s on", at_rest(found, 18.0), 3e-3)
    assert found.summary["spilled"] == 0.0


@pytest.mark.parametrize("flow", [0.1, -0.1])
def test_disturbance_is_found_and_its_parts_are_accounted_for(flow):
    settings = ("plant.disturbance_times=5", f"plant.disturbance_values={flow}")
    found = run("paper", "controller.estimator=on", "run.duration=20", *settings)
    assert found["disturbance"][-1] == pytest.approx(flow, rel=0.01)
    assert found.summary["disturbed"] == pytest.approx(15.0 * flow, rel=1e-9)
    hold("balance error", abs(found.summary["balance_error"]), 1e-5)
    hold("left from 15 s on", at_rest(found, 15.0), 1e-3)


def test_samples_that_come_seldom_are_waited_for():
    settings = ("controller.estimator=on", "plant.level_sample_time=0.05", "run.duration=20")
    found = run("paper", *settings)
    assert found.summary["error_bits"] == 0
    held = np.diff(found["level_measured"].reshape(-1)[: 20 * 400].reshape(400, 20), axis=1)
    assert np.all(held == 0.0)
    hold("left from 10 s on", at_rest(found, 10.0), 1e-4)
