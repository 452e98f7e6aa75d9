# SPDX-License-Identifier: MIT
"""What the controller says and does while something is wrong, and how it starts again."""

import numpy as np
import pytest

from tests.system.command import belt_sim
from tests.system.faults import (
    AUTOMATIC,
    HOLD,
    LATE,
    LENGTH,
    MANUAL,
    MISMATCH,
    MISSING,
    REPEATED,
    STALE,
    START,
    SUBSTITUTE,
    faulty,
    settings_for,
)
from tests.system.runs import PERIOD, hold, run


def bits_during(found, after=0.0):
    """All the error bits from `after` a fault's start to its end."""
    time = found["time"]
    at_work = (time > START + after - PERIOD / 2) & (time < START + LENGTH - PERIOD / 2)
    return np.bitwise_or.reduce(found["error_bits"][at_work].astype(int))


@pytest.mark.parametrize(
    "fault, bits",
    [
        ("buffer_level:off", MISSING),
        ("buffer_level:stuck", STALE),
        ("valve:off", MISMATCH),
        ("valve:wrong=0.8", MISMATCH),
        ("period:wrong=3", LATE),
        ("period:wrong=0", REPEATED),
        ("period:intermittent=0.3", LATE),
    ],
)
def test_fault_is_named_and_nothing_else(fault, bits):
    assert bits_during(faulty(fault, *settings_for(fault, "on"))) == bits


@pytest.mark.parametrize("word, bit", [("off", MISSING), ("stuck", STALE)])
def test_lost_level_is_noticed_within_one_step(word, bit):
    found = faulty(f"buffer_level:{word}", *settings_for("buffer_level", "on"))
    first = found["time"][(found["error_bits"].astype(int) & bit) != 0][0]
    assert first <= START + PERIOD * 1.5


def test_absent_level_is_no_number_in_the_trace():
    found = faulty("buffer_level:off", *settings_for("buffer_level", "on"))
    lost = np.isnan(found["level_measured"])
    assert lost.sum() == round(LENGTH / PERIOD)
    assert found["time"][lost][0] == pytest.approx(START)


def test_level_that_stays_away_is_held_then_substituted_then_trusted_again():
    found = run("stuck_sensor")
    modes = found["mode"].astype(int)
    changes = [AUTOMATIC, *modes[1:][np.diff(modes) != 0]]
    assert changes == [AUTOMATIC, HOLD, SUBSTITUTE, AUTOMATIC]
    assert found["inlet_flux"][modes == SUBSTITUTE][-1] == pytest.approx(0.9, abs=1e-3)
    hold("left at the end", abs(found.summary["final_error"]), 1e-4)


def test_sound_run_raises_no_alarm_in_many_steps():
    """The same in a million: tools/test has no time for it, and nothing changes after the first."""
    settings = ("controller.estimator=on", "run.duration=250", "plant.substeps=1")
    summary = run("paper", *settings).summary
    assert summary["steps"] == 100_001
    assert summary["error_bits"] == 0
    assert summary["rows_automatic"] == 100_001


def test_task_that_hangs_keeps_its_command_and_catches_up():
    found = faulty("period:stuck", *settings_for("period", "on"), times=(0.8, 0.1))
    hung = (found["time"] > 0.8 - PERIOD / 2) & (found["time"] < 0.9 - PERIOD / 2)
    before = found["inlet_flux"][found["time"] < 0.8 - PERIOD / 2][-1]
    assert np.all(found["inlet_flux"][hung] == before)
    assert found.summary["steps"] == len(found["time"]) - hung.sum() == len(found["time"]) - 40
    assert found["error_bits"][np.flatnonzero(hung)[-1] + 1] == LATE
    # 40 periods made up for in one step: the belt is known as before
    hold("observer error [parts/m]", found["observer_error"][-1], 2e-3)


def test_power_cut_is_a_hang_with_a_closed_valve(tmp_path):
    """Nothing of the controller's memory is left in the one, all of it in the other."""
    traces = []
    for name, faults in [
        ("cut", ["period:off@1+0.1"]),
        ("hang", ["period:stuck@1+0.1", "valve:off@1+0.1"]),
    ]:
        words = [word for fault in faults for word in ("--fault", fault)]
        trace = tmp_path / name
        assert belt_sim("run", "paper", *words, "--trace", trace).returncode == 0
        traces.append(trace.read_bytes())
    assert traces[0] == traces[1]


@pytest.mark.parametrize("settings", [(), ("run.snapshot_period=0.1",)])
@pytest.mark.parametrize("length", [0.0025, 0.1, 2.0])
def test_restart_returns_to_the_sound_run(length, settings):
    duration = "run.duration=15"
    cut = faulty("period:off", *settings, duration, times=(3.0, length))
    assert cut.summary["rows_automatic"] == len(cut["time"])
    hold("left at the end", abs(cut.summary["final_error"]), 1e-5)


def test_restart_without_any_snapshot_is_a_cold_start():
    found = faulty("period:off", "run.duration=15", times=(0.0, 0.5))
    assert found["applied_flux"][found["time"] <= 0.5].max() == 0.0
    hold("left at the end", abs(found.summary["final_error"]), 1e-5)


def test_restart_keeps_set_point_and_mode(tmp_path):
    """A change between the last snapshot and the cut is said again by the operator."""
    settings = (
        "run.setpoint_times=2.95",
        "run.setpoint_levels=0.25",
        "run.mode_times=2.96",
        "run.mode_values=manual",
        "run.manual_flux=0.7",
        "run.snapshot_period=1",
        "run.duration=6",
    )
    found = faulty("period:off", *settings, times=(3.0, 0.05))
    after = found["time"] > 3.06
    assert np.all(found["mode"][after] == MANUAL)
    assert np.all(np.abs(found["level_setpoint"][after] - 0.25) < 1e-7)
    assert found["inlet_flux"][-1] == pytest.approx(0.7, abs=1e-4)
