# SPDX-License-Identifier: MIT
"""float32 and double make of the same inputs the same command, step by step."""

import os
import subprocess

import numpy as np
import pytest

from tests.system.runs import greatest, hold, run


def recorded(found):
    """The inputs of every step of a run of the float32 controller, as belt_replay reads them."""
    level = found["buffer_level"].astype(np.float32).astype(float)
    applied = np.append(0.0, found["inlet_flux"][:-1])
    rows = zip(found["level_setpoint"], level, applied, strict=True)
    return "".join("{:.17g},{:.17g},{:.17g}\n".format(*row) for row in rows)


def commands(program, scenario, rows):
    """What the controller of a build answers to recorded rows."""
    command = [os.environ[program], scenario]
    result = subprocess.run(command, input=rows, capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr
    return np.array(result.stdout.split(), dtype=float)


@pytest.mark.parametrize(
    "scenario", ["paper", "heavy_window", "lossy_profile", "setpoint_steps", "loaded_line"]
)
def test_float32_step_is_the_double_step(scenario):
    found = run(scenario)
    rows = recorded(found)
    single = commands("BELT_REPLAY", scenario, rows)
    double = commands("BELT_REPLAY_F64", scenario, rows)
    # the replay is the run: only then is what follows said of the run
    assert np.array_equal(single, found["inlet_flux"])
    # the aim (the bar is 5e-5): what rounding of the predicted level, some 2e-7, makes of a flux
    # whose law is as steep as 22/s and whose losses are made up for on top
    hold("share of the peak", greatest(single - double) / greatest(single), 1e-5)


def test_replay_that_differs_in_one_input_differs_in_its_command():
    found = run("paper")
    rows = recorded(found).splitlines(keepends=True)
    setpoint, level, applied = rows[1000].split(",")
    rows[1000] = f"{setpoint},{float(level) * 1.001:.17g},{applied}"
    changed = commands("BELT_REPLAY", "paper", "".join(rows))
    assert np.array_equal(changed[:1000], found["inlet_flux"][:1000])
    assert changed[1000] != found["inlet_flux"][1000]


@pytest.mark.parametrize("rows", ["0.3,0\n", "0.3,0,x\n", "0.3,nan,0\n", "2,0,0\n"])
def test_bad_row_ends_the_replay(rows):
    command = [os.environ["BELT_REPLAY"], "paper"]
    result = subprocess.run(command, input=rows, capture_output=True, text=True, timeout=60)
    assert result.returncode == 1
    assert result.stderr.count("\n") == 1
