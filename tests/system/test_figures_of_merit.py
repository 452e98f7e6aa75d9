# SPDX-License-Identifier: MIT
"""What the controller promises of the closed loop, judged by the shift theorem.

Each limit is the promised one or the better one that was aimed at. To see the figures:
python -m pytest tests/system -rP -k "figures or plant or prediction or replay or instructions"
"""

import numpy as np
import pytest

from reference.line import Law, Line
from reference.trajectories import FOLDER
from tests.system.runs import LINES, LOADED, PERIOD, greatest, hold, run, shift_error

COMBINATION = (
    "law.level_setpoint=0.45",
    "line.rework_rate=0.3",
    "line.loss_rate=0.5",
    "line.speed_window=3",
)


COMBINED_LINE = Line(rework_rate=0.3, loss_rate=(0.5,), speed_window=3.0)
COMBINED_LAW = Law(level_setpoint=0.45)


@pytest.mark.parametrize(
    "scenario, settings, line, law, start, least",
    [
        # the aim (the bar is 1.8)
        ("paper", (), Line(), Law(), {}, 3.5),
        # well above the 2 of the first order; the sup moves from place to place
        ("heavy_window", (), LINES["heavy_window"], Law(), {}, 3.0),
        ("lossy_profile", (), LINES["lossy_profile"], Law(), {}, 3.0),
        ("loaded_line", (), Line(), Law(), LOADED, 3.0),
        ("paper", COMBINATION, COMBINED_LINE, COMBINED_LAW, {}, 3.0),
    ],
    ids=["paper", "heavy_window", "lossy_profile", "loaded_line", "combination"],
)
def test_controller_is_of_second_order(scenario, settings, line, law, start, least):
    """In double, with plant steps of 0.3 and 0.08 ms, whose own error of 1e-7 does not show.

    Over four times the nodes: with each doubling the sup moves to another time, for the terms of a
    step are of third order where the line is smooth and of second at corners.
    """
    errors = []
    for node_count, period in ((20, 2.5e-3), (80, 6.25e-4)):
        found = run(
            scenario,
            *settings,
            f"controller.node_count={node_count}",
            f"controller.period={period}",
            "plant.substeps=8",
            "plant.node_count=1600",
            "run.duration=6",
            program="BELT_SIM_F64",
        )
        errors.append(greatest(shift_error(found, line, law, **start)))
    each = np.sqrt(errors[0] / errors[1])
    print(f"sup {errors[0]:.3g} and {errors[1]:.3g}, divided by {each:.3g} with each doubling")
    assert each >= least


def test_nothing_but_rounding_is_left_at_equilibrium():
    # the aim (the bar is 1e-5)
    hold("left at 10 s", abs(run("paper").summary["final_error"]), 2e-6)


@pytest.mark.parametrize("scenario", ["paper", "heavy_window"])
def test_level_follows_the_shift_theorem(scenario):
    # the aim (the bar is 3e-4)
    hold("sup", greatest(shift_error(run(scenario), LINES[scenario])), 1e-4)


def test_level_follows_the_shift_theorem_where_the_loss_varies_along_the_belt():
    # the aim (the bar is 5e-4)
    hold("sup", greatest(shift_error(run("lossy_profile"), LINES["lossy_profile"])), 2e-4)


def test_level_follows_the_shift_theorem_with_much_rework_and_a_long_window():
    found = run("paper", *COMBINATION)
    # the aim (the bar is 5e-4)
    hold("sup", greatest(shift_error(found, COMBINED_LINE, COMBINED_LAW)), 2e-4)


@pytest.mark.parametrize("after", [0.45, 0.25])
def test_setpoint_step_arrives_one_dead_time_later(after):
    found = run("paper", "run.setpoint_times=3", f"run.setpoint_levels={after}")
    error = shift_error(found, setpoint_times=(3.0,), setpoint_levels=(after,), period=PERIOD)
    assert found["inlet_flux"].min() > 0.0  # else the theorem would not hold
    # the aim (the bar is 1e-3)
    hold("sup", greatest(error), 3e-4)
    assert abs(found["buffer_level"][-1] - after) < 1e-5  # the bar of the equilibrium


def golden_flux_at_0():
    """How long [s] the reference, clamped alike, feeds nothing in its step from 0.45 to 0.30."""
    rows = np.genfromtxt(FOLDER / "setpoint_steps.csv", delimiter=",", names=True)
    return float(np.sum(rows["inlet_flux"] == 0.0) * (rows["time"][1] - rows["time"][0]))


def test_step_that_asks_for_less_than_no_flux_recovers_without_wind_up():
    found = run(
        "paper", "law.level_setpoint=0.45", "run.setpoint_times=3", "run.setpoint_levels=0.3"
    )
    closed = found["time"][found["inlet_flux"] == 0.0]
    assert closed.min() == pytest.approx(3.0, abs=1e-12)  # the very step that asks for it
    assert np.all(np.diff(closed) < 1.5 * PERIOD)  # once, and then it leaves 0
    # as long as in the golden run of this step, whose rows are 20 ms apart: one at each end
    golden = golden_flux_at_0()
    hold("flux at 0 for [s], less the golden run's", abs(len(closed) * PERIOD - golden), 0.04)
    error = shift_error(
        found,
        law=Law(level_setpoint=0.45),
        setpoint_times=(3.0,),
        setpoint_levels=(0.3,),
        period=PERIOD,
    )
    # no bar: the theorem knows no clamp. Measured 1.40e-3, as in the golden run of the reference
    hold("sup", greatest(error), 1.5e-3)
    # wind-up would show as a level below the set-point
    hold("beyond the set-point [share]", found.summary["overshoot"], 1e-4)
    hold("left at the end", abs(found.summary["final_error"]), 2e-6)


def test_line_that_starts_loaded_follows_the_reference():
    # the aim (the bar is 1e-3)
    hold("sup", greatest(shift_error(run("loaded_line"), **LOADED)), 3e-4)


# 1 part of the paper is 100 parts, 1 s is 1/60 min, 1 m is 1/0.3048 ft
UNITS = {
    "time": 1 / 60,
    "buffer_level": 100,
    "level_setpoint": 100,
    "inlet_flux": 100 * 60,
    "outlet_flux": 100 * 60,
    "congestion": 100 / 60,
    "transport_speed": 60 / 0.3048,
    "predicted_level": 100,
    "arrival_time": 1 / 60,
    "survival": 1,
    "level_measured": 100,
    "applied_flux": 100 * 60,
    "disturbance": 100 * 60,
    "mode": 1,
    "error_bits": 1,
    "level_estimate": 100,
    "level_quality": 1,
    "observer_error": 100 * 0.3048,
}


@pytest.mark.parametrize(
    "program, node_count, limit",
    [
        # the bar; rounding alone is 1e-13. 200 periods are 20 cells to the last bit, and 21 too
        ("BELT_SIM_F64", 20, 1e-9),
        ("BELT_SIM_F64", 21, 1e-9),
        ("BELT_SIM", 20, 1e-5),  # the aim (the bar is 1e-4)
        # the bar: where two cuts of a cell weigh alike, rounding decides which one it keeps
        ("BELT_SIM", 21, 1e-4),
    ],
)
def test_other_units_give_the_same_run(program, node_count, limit):
    nodes = f"controller.node_count={node_count}"
    paper = run("paper", nodes, program=program)
    other = run("parts_and_minutes", nodes, program=program)
    assert paper.trace.keys() == UNITS.keys()
    for name, unit in UNITS.items():
        difference = greatest(other[name] / unit - paper[name])
        peak = greatest(paper[name]) or 1.0  # some are 0 all along
        # of 64 places in a cell the one on a jump lies on either side of it, as rounding has it
        bar = max(limit, 1 / 64) if name == "observer_error" else limit
        hold(f"{name}, share of its peak", difference / peak, bar)


def law(scenario, name):
    return run(scenario, f"controller.law={name}")


@pytest.mark.parametrize("scenario", ["paper", "heavy_window"])
def test_predictor_does_not_overshoot(scenario):
    hold("overshoot [share]", law(scenario, "predictor").summary["overshoot"], 1e-3)


@pytest.mark.parametrize("scenario", ["paper", "heavy_window"])
def test_open_loop_ends_at_the_setpoint(scenario):
    hold("left at 10 s", abs(law(scenario, "open_loop").summary["final_error"]), 1e-3)


def test_uncompensated_law_swings_and_stays_low_in_the_papers_case():
    found = law("paper", "uncompensated")
    late = found["buffer_level"][found["time"] >= 6.0]
    print(f"peak-to-peak {np.ptp(late):.3g} parts, mean {100 * late.mean() / 0.3 - 100:.3g} %")
    assert np.ptp(late) >= 0.015
    assert late.mean() <= 0.95 * 0.3


def test_uncompensated_law_rests_far_too_low_in_a_long_window():
    found = law("heavy_window", "uncompensated")
    late = found["buffer_level"][found["time"] >= 6.0]
    print(f"mean {100 * late.mean() / 0.3 - 100:.3g} %")
    assert late.mean() <= 0.85 * 0.3


def test_frozen_dead_time_takes_three_times_as_long_to_settle():
    frozen = law("heavy_window", "frozen").summary["settling_time"]
    predictor = law("heavy_window", "predictor").summary["settling_time"]
    print(f"settling: frozen {frozen:.4g} s, predictor {predictor:.4g} s")
    assert frozen >= 3.0 * predictor
    # both as on an independent prototype, 4.65 s and 1.294 s, to the promised two digits
    assert predictor == pytest.approx(1.294, abs=0.005)
    assert frozen == pytest.approx(4.65, abs=0.05)
