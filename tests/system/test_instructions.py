# SPDX-License-Identifier: MIT
"""What a step costs, in instructions counted one by one: the same figures at every run."""

import json
import os
import subprocess
from pathlib import Path

import pytest

from tests.system.runs import hold

TOOL = Path(__file__).resolve().parents[2] / "tools" / "instructions"


def count(scenarios, *more):
    """{(scenario, nodes): row}"""
    command = [TOOL, "--program", os.environ["BELT_SIM"], "--json", "--scenarios", *scenarios]
    result = subprocess.run([*command, *more], capture_output=True, text=True, timeout=600)
    assert result.returncode == 0, result.stderr
    return {(row["scenario"], row["node_count"]): row for row in json.loads(result.stdout)}


@pytest.fixture(scope="module")
def figures():
    """Runs of 1.5 s: the empty line, the front's arrival and the settled level."""
    return count(["paper", "heavy_window"])


@pytest.fixture(scope="module")
def figures_of_all():
    """The same with the estimator on; and the shipped faults, long enough to meet and to end."""
    automatic = count(
        ["paper", "heavy_window", "lossy_profile"],
        *("--nodes", "20", "--set", "controller.estimator=on"),
    )
    faults = count(
        ["noisy_sensor", "stuck_sensor", "operator", "valve_limit"],
        "--nodes",
        "20",
        "--duration",
        "10",
    )
    return {scenario: row for (scenario, _), row in (automatic | faults).items()}


@pytest.mark.parametrize("scenario", ["paper", "heavy_window"])
def test_no_step_of_20_nodes_takes_more_than_5000_instructions(scenario, figures):
    row = figures[scenario, 20]
    assert row["steps"] == 601
    # the bar (the aim is 2500); the first step, which fills the speed window, is one of them
    hold("greatest", row["greatest"], 5000)


@pytest.mark.parametrize("scenario", ["paper", "heavy_window"])
def test_a_step_with_everything_in_it_keeps_its_bar(scenario, figures_of_all):
    # the bar (the aim is 3000)
    hold("greatest", figures_of_all[scenario]["greatest"], 6500)


@pytest.mark.parametrize("scenario", ["paper", "heavy_window", "lossy_profile", "noisy_sensor"])
def test_all_steps_of_automatic_cost_about_the_same(scenario, figures_of_all):
    row = figures_of_all[scenario]
    # the bar (the aim of 1.10 is met but for a loss profile)
    hold("greatest over least", row["greatest"] / row["least"], 1.25)


@pytest.mark.parametrize("scenario", ["stuck_sensor", "operator", "valve_limit"])
def test_no_fault_and_no_mode_costs_more_than_automatic(scenario, figures_of_all):
    # Measured 4303 in automatic, 4304 at the return of a stuck sensor: where the belt stands in the
    # period of the greatest count is worth some ten instructions: half a per cent is room for it.
    automatic = max(figures_of_all[name]["greatest"] for name in ("paper", "noisy_sensor"))
    hold("greatest", figures_of_all[scenario]["greatest"], 1.005 * automatic)


@pytest.mark.parametrize("scenario", ["paper", "heavy_window"])
def test_a_step_costs_in_proportion_to_the_nodes(scenario, figures):
    # the aim is 8.5 (the bar is 16): 8 times the nodes, and what does not depend on them
    for name in ("mean", "greatest"):
        hold(name, figures[scenario, 160][name] / figures[scenario, 20][name], 8.5)


def test_program_that_is_not_there_is_said_to_fail(tmp_path):
    command = [TOOL, "--program", tmp_path / "none", "--scenarios", "paper", "--nodes", "20"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert result.returncode == 1
    assert result.stdout == "" and result.stderr.startswith("instructions: ")
