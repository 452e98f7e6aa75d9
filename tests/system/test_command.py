# SPDX-License-Identifier: MIT
"""The command line: what is done, what is refused, and with which exit code."""

import configparser
import csv
import json
import os
import re

import pytest

from tests.system.command import SCENARIOS, SHIPPED, SHORT, assert_refused, belt_sim

SUMMARY_KEYS = [
    "settling_time",
    "overshoot",
    "iae",
    "inlet_flux_peak",
    "inlet_flux_variation",
    "final_error",
    "spilled",
    "balance_error",
    "steps",
    "level_peak",
    "disturbed",
    "error_bits",
    "rows_off",
    "rows_manual",
    "rows_automatic",
    "rows_hold",
    "rows_substitute",
]
TRACE_COLUMNS = [
    "time",
    "buffer_level",
    "level_setpoint",
    "inlet_flux",
    "outlet_flux",
    "congestion",
    "transport_speed",
    "predicted_level",
    "arrival_time",
    "survival",
    "level_measured",
    "applied_flux",
    "disturbance",
    "mode",
    "error_bits",
    "level_estimate",
    "level_quality",
    "observer_error",
]


def test_list_names_each_shipped_scenario_with_its_opening_sentence():
    result = belt_sim("list")
    assert result.returncode == 0
    lines = result.stdout.splitlines()
    assert [line.split()[0] for line in lines] == SHIPPED
    for line in lines:
        assert re.fullmatch(r"\w+ +[A-Z].*\.", line), line
        assert "SPDX" not in line


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenario_holds_every_rule_and_runs(name):
    assert belt_sim("check", name).returncode == 0
    result = belt_sim("run", name)
    assert result.returncode == 0, result.stderr
    assert result.stderr == ""
    assert list(json.loads(result.stdout)) == SUMMARY_KEYS


@pytest.mark.parametrize("name", SHIPPED)
def test_configparser_reads_a_shipped_scenario_as_belt_sim_does(name, tmp_path):
    parser = configparser.ConfigParser(interpolation=None, strict=True)
    parser.read(SCENARIOS / f"{name}.ini", encoding="utf-8")
    empty = tmp_path / "empty.ini"
    empty.write_text("")
    settings = []
    for section in parser.sections():
        for key, value in parser.items(section):
            settings += ["--set", f"{section}.{key}={value}"]
    by_file, by_settings = tmp_path / "file.csv", tmp_path / "settings.csv"
    assert belt_sim("run", name, "--trace", by_file).returncode == 0
    assert belt_sim("run", empty, *settings, "--trace", by_settings).returncode == 0
    assert by_file.read_bytes() == by_settings.read_bytes()


def test_shipped_name_is_found_from_any_working_directory(tmp_path):
    assert belt_sim("run", "paper", *SHORT, cwd=tmp_path).returncode == 0
    assert belt_sim("run", "paper", *SHORT, cwd="/").returncode == 0


def test_folder_of_shipped_scenarios_can_be_named_in_the_environment(tmp_path):
    (tmp_path / "mine.ini").write_text("# A line of mine. And more.\n[run]\nduration = 0.1\n")
    environment = {**os.environ, "BELT_SIM_SCENARIOS": str(tmp_path)}
    result = belt_sim("list", env=environment)
    assert result.stdout.split() == ["mine", "A", "line", "of", "mine."]
    assert belt_sim("run", "mine", env=environment).returncode == 0


def test_path_is_told_from_a_shipped_name_by_slash_or_suffix(tmp_path):
    for name in ("paper", "own.ini"):
        (tmp_path / name).write_text("[run]\nduration = 0.1\n")
    paths, shipped = ("./paper", "own.ini"), "paper"
    steps = [json.loads(belt_sim("run", path, cwd=tmp_path).stdout)["steps"] for path in paths]
    assert steps[0] == steps[1] < 100
    assert json.loads(belt_sim("run", shipped, cwd=tmp_path).stdout)["steps"] >= 4000


def test_trace_has_the_promised_columns_and_a_row_for_each_period(tmp_path):
    trace = tmp_path / "trace.csv"
    assert belt_sim("run", "paper", *SHORT, "--trace", trace).returncode == 0
    assert b"\r" not in trace.read_bytes()
    rows = list(csv.reader(trace.read_text().splitlines()))
    assert rows[0][: len(TRACE_COLUMNS)] == TRACE_COLUMNS
    assert len(rows) == 1 + 41
    assert {len(row) for row in rows} == {len(rows[0])}
    for row, index in zip(rows[1:], range(41)):
        # the time is a product or a sum of periods: a rounding of each is 1e-16
        assert float(row[0]) == pytest.approx(0.0025 * index, abs=1e-14)


def test_densities_stand_under_their_places(tmp_path):
    densities = tmp_path / "density.csv"
    settings = ("--set", "initial.density=0.5", "--set", "plant.belt_length=3")
    assert belt_sim("run", "paper", *SHORT, *settings, "--density", densities).returncode == 0
    header, first = densities.read_text().splitlines()[:2]
    places = header.split(",")
    assert places[0] == "time" and float(places[1]) == 0 and float(places[-1]) == 3
    assert len(first.split(",")) == len(places)
    assert len(densities.read_text().splitlines()) == 1 + 41


def test_summary_stands_in_its_file_and_then_not_on_standard_output(tmp_path):
    summary = tmp_path / "summary.json"
    shown = belt_sim("run", "paper", *SHORT)
    filed = belt_sim("run", "paper", *SHORT, "--summary", summary)
    assert filed.returncode == 0 and filed.stdout == ""
    assert summary.read_text() == shown.stdout


def test_second_run_gives_the_same_bytes(tmp_path):
    outputs = {f"--{name}": tmp_path / name for name in ("trace", "density", "summary")}
    options = [word for pair in outputs.items() for word in pair]
    contents = []
    for _ in range(2):
        assert belt_sim("run", "setpoint_steps", *SHORT, *options).returncode == 0
        contents.append([path.read_bytes() for path in outputs.values()])
    assert contents[0] == contents[1]


def test_check_says_by_its_exit_code_whether_the_rules_hold():
    assert belt_sim("check", "paper").returncode == 0
    broken = belt_sim("check", "paper", "--set", "law.level_setpoint=0")
    assert broken.returncode == 2
    assert "level_setpoint" in broken.stdout


def test_help_is_not_a_mistake():
    for arguments in (["--help"], ["run", "--help"], ["-h"]):
        result = belt_sim(*arguments)
        assert result.returncode == 0 and result.stderr == ""
        assert "belt_sim run SCENARIO" in result.stdout


@pytest.mark.parametrize(
    "arguments, part",
    [
        ([], "the command must be run, check or list"),
        (["walk"], "the command must be"),
        (["run"], "run wants a scenario"),
        (["check"], "check wants a scenario"),
        (["run", ""], "one argument too many"),
        (["run", "paper", "heavy_window"], '"heavy_window" is one argument too many'),
        (["list", "paper"], '"paper" is one argument too many'),
        (["list", "--set", "run.duration=1"], "unknown option --set"),
        (["list", "--fault", "valve:off@1+1"], "unknown option --fault"),
        (["run", "paper", "--fault"], "--fault has no value"),
        (["check", "paper", "--trace", "x.csv"], "unknown option --trace for check"),
        (["run", "paper", "--trase", "x.csv"], "unknown option --trase for run"),
        (["run", "paper", "--trace=x.csv"], "unknown option --trace=x.csv"),
        (["run", "paper", "--tr", "x.csv"], "unknown option --tr"),
        (["run", "paper", "-t", "x.csv"], "unknown option -t"),
        (["run", "paper", "--trace"], "--trace has no value"),
        (["run", "paper", "--trace", ""], "--trace has no value"),
        (["run", "paper", "--trace", "--summary", "s"], "--trace has no value"),
        (["run", "paper", "--set"], "--set has no value"),
        (["run", "paper", "--trace", "a", "--trace", "b"], "--trace stands twice"),
        (["run", "paper", "--set", "duration=1"], "must be section.key=value"),
        (["run", "paper", "--set", "run.duration=x"], '[run] duration = x: "x" is not'),
        (["run", "paper", "--set", "run.duraton=1"], "[run] duraton = 1: unknown key"),
        (["run", "paper", "--set", "run.setpoint_times=1"], "setpoint_levels has 0"),
        (["run", "papers"], "no shipped scenario of that name; known: heavy_window"),
        (["run", "missing.ini"], "missing.ini: No such file"),
        (["run", "./folder.ini"], "is not a regular file"),
        (["run", "/dev/zero"], "is not a regular file"),
        (["check", "papers"], "no shipped scenario"),
    ],
)
def test_misuse_is_refused_with_one_line(arguments, part, tmp_path):
    (tmp_path / "folder.ini").mkdir()
    assert_refused(belt_sim(*arguments, cwd=tmp_path), part)
    assert [path.name for path in tmp_path.iterdir()] == ["folder.ini"]
