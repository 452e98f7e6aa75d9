# SPDX-License-Identifier: MIT
"""Faults between plant and controller: how they are written, and that a run survives each of them.

Grammar and ranges in full: tests/unit/test_scenario_faults.c. What each fault does to a signal:
tests/unit/test_channel.c and test_task.c.
"""

import json

import numpy as np
import pytest

from tests.system.command import SHORT, assert_refused, belt_sim, names_in
from tests.system.faults import (
    AUTOMATIC,
    DURATION,
    FAULTS,
    FLUX_MAX,
    FLUX_RATE_MAX,
    PROGRAMS,
    START,
    faulty,
    scenario_for,
    settings_for,
)
from tests.system.runs import PERIOD, greatest, hold, run


def assert_command_is_sound(found):
    flux = found["inlet_flux"]
    assert np.all(np.isfinite(flux))
    assert np.all((flux >= 0.0) & (flux <= FLUX_MAX))
    # to a rounding of float32
    assert greatest(np.diff(flux)) <= FLUX_RATE_MAX * PERIOD * (1 + 1e-5)


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("fault", FAULTS)
def test_run_returns_to_the_sound_one_after_any_fault(fault, program):
    settings = settings_for(fault, "on")
    scenario = scenario_for(fault)
    found = faulty(fault, *settings, scenario=scenario, program=program)
    sound = run(scenario, *settings, program=program)
    assert_command_is_sound(found)
    before = found["time"] < START - PERIOD / 2
    for column in ("buffer_level", "inlet_flux", "error_bits"):
        assert np.array_equal(found[column][before], sound[column][before])
    last = found["time"] > DURATION - 1.0
    assert np.all(found["mode"][last] == AUTOMATIC)
    assert np.all(found["error_bits"][last] == 0)
    # what is left of it after 16 s: float32 of two runs that came another way
    hold("level", greatest((found["buffer_level"] - sound["buffer_level"])[last]), 1e-4)


@pytest.mark.parametrize("fault", FAULTS)
def test_run_returns_without_estimator_too(fault):
    settings = settings_for(fault, "off")
    scenario = scenario_for(fault)
    found = faulty(fault, *settings, scenario=scenario)
    sound = run(scenario, *settings)
    assert_command_is_sound(found)
    last = found["time"] > DURATION - 1.0
    hold("level", greatest((found["buffer_level"] - sound["buffer_level"])[last]), 1e-4)


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("fault", FAULTS)
def test_fault_at_the_very_start_is_survived(fault, program, tmp_path):
    settings = [word for each in settings_for(fault, "on") for word in ("--set", each)]
    short = ("--set", "run.duration=1")
    result = belt_sim(
        "run", "paper", *settings, *short, "--fault", f"{fault}@0+0.5", program=program
    )
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""


@pytest.mark.parametrize("seed", range(5))
def test_many_faults_at_once_are_survived(seed):
    chance = np.random.default_rng(seed)
    faults = []
    for fault in chance.choice(FAULTS, size=12, replace=False):
        start, length = chance.uniform(0.0, 6.0), chance.uniform(0.01, 3.0)
        faults += ["--fault", f"{fault}@{start:.4f}+{length:.4f}"]
    settings = settings_for("", "on")
    settings += ["controller.density=measured", "controller.outlet_flux=measured"]
    settings += [f"plant.seed={seed}", "plant.level_noise=0.01", "run.duration=10"]
    words = [word for setting in settings for word in ("--set", setting)]
    result = belt_sim("run", "paper", *words, *faults, program=PROGRAMS[-1])
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["spilled"] >= 0.0


def test_faults_of_the_command_line_and_of_the_file_give_the_same_run(tmp_path):
    valve, level = "valve:off@0.02+0.02", "buffer_level:garbage@0.05+0.02"
    traces = []
    for name, words in [
        ("set", ("--set", f"run.faults={valve}, {level}")),
        ("fault", ("--fault", valve, "--fault", level)),
        ("both", ("--fault", level, "--set", f"run.faults={valve}")),
    ]:
        trace = tmp_path / name
        assert belt_sim("run", "paper", *SHORT, *words, "--trace", trace).returncode == 0
        traces.append(trace.read_bytes())
    assert traces[0] == traces[1] == traces[2]


def test_run_of_chance_is_its_seeds(tmp_path):
    contents = {}
    for name, seed in (("one", 1), ("again", 1), ("other", 2)):
        words = ("--set", f"plant.seed={seed}", "--set", "plant.level_noise=0.01")
        fault = ("--fault", "buffer_level:garbage@0.02+0.02")
        trace = tmp_path / name
        assert belt_sim("run", "paper", *SHORT, *words, *fault, "--trace", trace).returncode == 0
        contents[name] = trace.read_bytes()
    assert contents["one"] == contents["again"] != contents["other"]


@pytest.mark.parametrize(
    "arguments, parts",
    [
        (["--fault", "level:off@1+1"], ["--fault: [run] faults", '"level" must be one of']),
        (["--fault", "valve:garbage@1+1"], ['"garbage"', "one of: off stuck wrong slow"]),
        (["--fault", "period:slow=1@1+1"], ['"slow"', "one of: off stuck garbage wrong"]),
        (["--fault", "valve:wrong@1+1"], ['value ""', "decimal number"]),
        (["--fault", "valve:intermittent=2@1+1"], ['"2"', "greater than 0 and at most 1"]),
        (["--fault", "valve:off@1"], ['time "1"', "start+length"]),
        (["--fault", "valve:off"], ["signal:word[=value]@start+length"]),
        (["--fault", "outlet_flux:off@1+1"], ["controller.outlet_flux must be measured"]),
        (["--fault", "density:off@1+1"], ["controller.density must be measured"]),
        (["--set", "run.faults=valve"], ["--set: [run] faults = valve"]),
        (["--set", "run.mode_times=1"], ["mode_values has 0"]),
        (["--set", "controller.transfer_time=1e9"], ["BELT_TRANSFER_TIME", "at most"]),
        (["--set", "controller.substitute_flux=100"], ["BELT_SUBSTITUTE_FLUX", "at most"]),
    ],
)
@pytest.mark.parametrize("command", ["run", "check"])
def test_refusal_names_its_parts_and_touches_no_output(command, arguments, parts, tmp_path):
    trace = tmp_path / "trace.csv"
    trace.write_text("old")
    outputs = ("--trace", trace) if command == "run" else ()
    result = belt_sim(command, "paper", *arguments, *outputs)
    if "BELT_" in parts[0] and command == "check":
        assert result.returncode == 2 and "BROKEN" in result.stdout
    else:
        assert_refused(result, *parts)
    assert trace.read_text() == "old"
    assert names_in(tmp_path) == ["trace.csv"]
