# SPDX-License-Identifier: MIT
"""What the estimator and the gate promise of a line that is not the model, by one shipped rule for
estimator_time.

Each limit is the promised one, or the better one that was aimed at where it is met. To see the
figures: tools/figures_of_merit -k robustness
"""

import numpy as np
import pytest

from reference.line import Law
from tests.system.runs import LINES, greatest, hold, run, shift_error

ON = "controller.estimator=on"
SETPOINT = 0.3
BAND = 0.02 * SETPOINT
LONG = "run.duration=25"
SCENARIOS = ["paper", "heavy_window"]

MODEL = {
    "processing_time": 0.25,
    "connectivity": 0.5,
    "rework_rate": 0.1,
    "loss_rate": 1.0,
    "speed_window": None,  # the line's own
    "belt_length": 2.0,
}


def value_of(scenario, key):
    return LINES[scenario].speed_window if key == "speed_window" else MODEL[key]


def back_within_band(found, since):
    """Time from `since` to the last moment outside 2 % of the set-point [s]."""
    late = found["time"] >= since
    outside = np.abs(found["buffer_level"] - SETPOINT) > BAND
    assert outside[late].any(), "nothing happened"
    return found["time"][late & outside][-1] - since


@pytest.mark.parametrize("scenario", SCENARIOS)
@pytest.mark.parametrize("factor", [0.8, 1.2])
@pytest.mark.parametrize("key", MODEL)
def test_robustness_any_number_of_the_model_a_fifth_off_ends_at_the_setpoint(key, factor, scenario):
    found = run(scenario, ON, LONG, f"plant.{key}={factor * value_of(scenario, key)!r}")
    late = found["buffer_level"][found["time"] >= 20.0]
    # the aim (the bar is 1e-3)
    hold(f"{scenario}, {key} x {factor}: left at 25 s", abs(found.summary["final_error"]), 1e-4)
    # the bar: no sustained oscillation
    hold(f"{scenario}, {key} x {factor}: peak-to-peak in the last 5 s", np.ptp(late), 1e-3)


@pytest.mark.parametrize("scenario", SCENARIOS)
@pytest.mark.parametrize("flow", [-0.1, 0.1])
def test_robustness_constant_disturbance_leaves_no_error(flow, scenario):
    found = run(
        scenario, ON, LONG, "plant.disturbance_times=10", f"plant.disturbance_values={flow}"
    )
    # the aims (the bars are 1e-3 and 5 s)
    hold(f"{scenario}, {flow}: left at 25 s", abs(found.summary["final_error"]), 1e-4)
    hold(f"{scenario}, {flow}: back to 2 % after [s]", back_within_band(found, 10.0), 3.0)


def test_robustness_without_estimator_the_same_disturbance_stays():
    """What the estimator is for: the law alone has no integral action."""
    found = run("paper", LONG, "plant.disturbance_times=10", "plant.disturbance_values=-0.1")
    assert abs(found.summary["final_error"]) > 0.02


@pytest.mark.parametrize(
    "window, limit",
    [
        (0.2, 3.0),  # the aim (the bar is 6 s)
        (3.0, 6.0),  # the bar: the aim of 3 s is missed
    ],
)
def test_robustness_jam_spills_nothing_and_ends(window, limit):
    """From 10 s to 15 s the buffer serves a third of what it takes to hold the set-point."""
    found = run(
        "paper",
        ON,
        f"line.speed_window={window}",
        "run.duration=25",
        "plant.service_times=10, 15",
        "plant.service_values=0.1, 0.8",
    )
    assert found.summary["spilled"] == 0.0
    assert found["buffer_level"].max() > SETPOINT + 0.1  # it was a jam
    hold(f"window {window}: back to 2 % after its end [s]", back_within_band(found, 15.0), limit)


@pytest.mark.parametrize("scenario", [*SCENARIOS, "lossy_profile"])
def test_robustness_estimator_leaves_the_nominal_case_alone(scenario):
    found = run(scenario, ON)
    # the aim (the bar is 1e-3)
    hold(f"{scenario}: sup", greatest(shift_error(found, LINES[scenario], Law())), 3e-4)


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_robustness_noise_hardly_moves_the_flux(scenario):
    noisy = ("plant.level_noise=0.005", "run.duration=20")
    with_estimator = run(scenario, ON, *noisy).summary["inlet_flux_variation"]
    without = run(scenario, *noisy).summary["inlet_flux_variation"]
    print(f"{scenario}: total variation {without:.4g} without, {with_estimator:.4g} with")
    # the aim (the bar is 1/10)
    hold(f"{scenario}: share of the variation left", with_estimator / without, 1 / 30)


# What the plant's belt holds at the start, and what the observer believes [parts/m].
WRONG_BELTS = [("0.5", "0"), ("0", "0.5"), ("0.1, 0.6, 0.2", "0.3")]
MUCH_REWORK = ("line.rework_rate=0.3", "line.loss_rate=0.5")


def transits_until_known(found):
    """Belt lengths the belt has moved when the observer's error stays below 1 % of its first."""
    share = found["observer_error"] / found["observer_error"][0]
    speed = found["transport_speed"]
    travel = (
        np.cumsum(np.append(0.0, 0.5 * (speed[1:] + speed[:-1]) * np.diff(found["time"]))) / 2.0
    )
    return travel[np.nonzero(share > 0.01)[0][-1]]


@pytest.mark.parametrize("scenario", SCENARIOS)
@pytest.mark.parametrize("more", [(), MUCH_REWORK], ids=["paper's rework", "much rework"])
@pytest.mark.parametrize("outlet_flux, limit", [("measured", 1.05), ("modelled", 2.2)])
@pytest.mark.parametrize("plant, observer", WRONG_BELTS)
def test_robustness_wrong_belt_is_forgotten(plant, observer, outlet_flux, limit, more, scenario):
    """A constant flux: what is seen is the observer's own error and not the law's answer."""
    found = run(
        scenario,
        "controller.law=open_loop",
        f"controller.outlet_flux={outlet_flux}",
        "initial.buffer_level=0.3",
        f"initial.density={plant}",
        f"initial.observer_density={observer}",
        "run.duration=4",
        *more,
    )
    # measured: the aim (the bar is 1.3); modelled: the bar (the aim is 2)
    hold(
        f"{scenario}, {plant} against {observer}: transits until below 1 %",
        transits_until_known(found),
        limit,
    )
