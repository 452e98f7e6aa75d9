# SPDX-License-Identifier: MIT
"""Loss of either sign: what grows on its way is fed the less."""

import numpy as np
import pytest

from reference.line import Line
from tests.system.command import belt_sim
from tests.system.runs import greatest, hold, run, shift_error

# The mean loss of the first is 0, of the second -0.6: more leaves than was fed.
PROFILES = [(-1.2, 1.2), (-1.0, 0.4, -1.5, -0.3), (-0.8,)]


def settings(profile):
    return (f"line.loss_rate={','.join(map(str, profile))}",)


@pytest.mark.parametrize("profile", PROFILES)
def test_level_follows_the_shift_theorem_where_the_belt_grows(profile):
    found = run("paper", *settings(profile))
    # as for a belt that only loses: the bar of lossy_profile
    hold("sup", greatest(shift_error(found, Line(loss_rate=profile))) / 0.3, 3e-4)
    assert abs(found.summary["balance_error"]) < 1e-5


def test_less_is_fed_where_more_grows():
    loses, grows = run("paper", *settings((0.8,))), run("paper", *settings((-0.8,)))
    # at rest the exponents are -0.8 and 0.8 times the dead time of 0.53 s
    ratio = loses["inlet_flux"][-1] / grows["inlet_flux"][-1]
    assert ratio > np.exp(1.6 * 0.53)
    assert grows["survival"][-1] == pytest.approx(np.exp(0.8 * 0.53), rel=1e-3)


def test_growth_beyond_the_bound_is_refused_by_name():
    answer = belt_sim("check", "paper", "--set", "line.loss_rate=-1,-40")
    assert answer.returncode == 2
    assert "BELT_LOSS_EXPONENT" in answer.stdout + answer.stderr
