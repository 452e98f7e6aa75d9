# SPDX-License-Identifier: MIT
"""The simulated line that the controller is judged on is itself right.

Set-point changes of the open loop are steps of a flux that nothing feeds back to, so two plants
get the same flux to the last bit, and fronts that travel down the belt.
"""

import numpy as np
import pytest

from reference.closed_loop import Run, simulate
from reference.line import Law, Line
from reference.upwind import drive
from tests.system.command import SHIPPED
from tests.system.runs import LINES, LOADED, LOSS_PROFILE, PERIOD, greatest, hold, run

TIMES, LEVELS = (2.0, 4.0, 6.0), (0.45, 0.2, 0.3)
STEPS = (
    "controller.law=open_loop",
    "run.duration=8",
    f"run.setpoint_times={','.join(map(str, TIMES))}",
    f"run.setpoint_levels={','.join(map(str, LEVELS))}",
)
FINE = ("plant.substeps=16", "plant.node_count=1600")  # four times the default
SCENARIOS = ["paper", "heavy_window", "lossy_profile", "loaded_line"]


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_characteristics_hardly_change_at_four_times_the_resolution(scenario):
    coarse, fine = run(scenario, *STEPS), run(scenario, *STEPS, *FINE)
    assert np.array_equal(coarse["inlet_flux"], fine["inlet_flux"])
    for name in ("buffer_level", "congestion", "transport_speed"):
        difference = greatest(coarse[name] - fine[name])
        hold(name, difference / max(1.0, greatest(fine[name])), 1e-5)


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_characteristics_hardly_change_in_the_closed_loop_either(scenario):
    coarse, fine = run(scenario), run(scenario, *FINE)
    hold("buffer_level", greatest(coarse["buffer_level"] - fine["buffer_level"]), 1e-5)


@pytest.mark.parametrize("scenario", SCENARIOS)
def test_characteristics_are_the_reference_line(scenario):
    start = LOADED if scenario == "loaded_line" else {}
    settings = {"setpoint_times": TIMES, "setpoint_levels": LEVELS, "step": PERIOD}
    expected = simulate(
        LINES[scenario], Law(), Run(duration=8.0, control="open_loop", **settings, **start)
    )
    found = run(scenario, *STEPS)
    assert np.allclose(found["time"], expected["time"], rtol=0, atol=1e-9)
    # the same bar for two schemes that share nothing; the reference's own error is 4e-6
    for name in ("buffer_level", "congestion"):
        hold(name, greatest(found[name] - expected[name]), 1e-5)


@pytest.mark.parametrize("scenario", SHIPPED)
def test_no_part_is_lost_or_made(scenario):
    found = run(scenario)
    fed = float(np.sum(found["inlet_flux"]) * (found["time"][1] - found["time"][0]))
    # loss and rework are integrated to second order: 7e-7 of all parts where the loss varies
    limit = 1e-12 if scenario == "paper_upwind" else 1e-6
    hold("balance error over parts fed", abs(found.summary["balance_error"]) / fed, limit)


def test_balance_error_is_of_second_order():
    errors = [
        abs(run("lossy_profile", *more).summary["balance_error"])
        for more in ((), ("plant.substeps=8", "plant.node_count=800"))
    ]
    assert errors[0] / errors[1] >= 3.5


UPWIND = {
    "paper_upwind": ((), Line(), {}),
    # a window that is no whole number of steps, a loss profile, a load, three steps a period
    "setpoint_steps": (
        (
            "plant.scheme=upwind",
            "plant.substeps=3",
            "plant.node_count=61",
            "line.speed_window=0.2011",
            f"line.loss_rate={','.join(map(str, LOSS_PROFILE))}",
            "initial.buffer_level=0.2",
            "initial.density=0.1,0.3,0.2",
        ),
        Line(speed_window=0.2011, loss_rate=LOSS_PROFILE),
        {"substeps": 3, "node_count": 61, **LOADED},
    ),
}


@pytest.mark.parametrize("law", ["predictor", "uncompensated"])
@pytest.mark.parametrize("scenario", UPWIND)
def test_upwind_plant_is_numpys(scenario, law):
    settings, line, more = UPWIND[scenario]
    found = run(scenario, *settings, f"controller.law={law}")
    expected = drive(line, found["inlet_flux"][:-1], PERIOD, **more)
    for name in ("buffer_level", "outlet_flux", "congestion"):
        # the same sums in another order: 5e-15
        difference = greatest(found[name] - expected[name]) / greatest(expected[name])
        hold(name, difference, 1e-12)
