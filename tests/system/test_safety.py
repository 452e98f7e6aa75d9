# SPDX-License-Identifier: MIT
"""The advice of `belt_sim check`: the C promises what the reference does, and refuses nothing."""

import re
from dataclasses import dataclass

import numpy as np
import pytest

from reference.line import Law, Line, profile
from reference.safety import State, proposition_2, sharper, starts_compatibly
from tests.system.command import belt_sim
from tests.system.runs import LINES

NUMBER = r"(-?[0-9.]+(?:e[-+]?[0-9]+)?)"
BOUND = re.compile(
    rf"  {{}}: (.*); {NUMBER} must be below {NUMBER} \S+, margin {NUMBER} "
    rf"\(u {NUMBER} parts/s, M {NUMBER} parts/m\)"
)
JUMP = re.compile(rf"  jump at the inlet: {NUMBER} parts/m")
VERDICTS = {
    "promises a positive inlet flux": (True, True),
    "promises nothing": (True, False),
    "does not apply to this state": (False, False),
}


@dataclass(frozen=True)
class Bound:
    left: float
    right: float
    margin: float
    flux_min: float
    density_max: float
    applies: bool
    holds: bool


def bound_of(text, name):
    verdict, *numbers = re.search(BOUND.pattern.format(name), text).groups()
    return Bound(*map(float, numbers), *VERDICTS[verdict])


def check(scenario, *settings, program="BELT_SIM"):
    """(proposition, sharper, jump) of one scenario; the exit code is that of its rules."""
    words = [word for setting in settings for word in ("--set", setting)]
    result = belt_sim("check", scenario, *words, program=program)
    assert result.returncode == 0, result.stdout
    text = result.stdout
    names = ("Proposition 2", "sharper bound")
    return *(bound_of(text, name) for name in names), float(JUMP.search(text)[1])


def numbers(values):
    return ", ".join(f"{value:.17g}" for value in np.atleast_1d(values))


def start(level, density):
    """The settings of a level [parts] and a belt [parts/m], outlet to inlet."""
    both = (f"initial.{key}={numbers(density)}" for key in ("density", "observer_density"))
    return f"initial.buffer_level={level:.17g}", *both


def settings_of(line, law):
    """A line and its law as settings."""
    keys = ("belt_length", "processing_time", "speed_window", "rework_rate", "loss_rate")
    return (
        *(f"line.{key}={numbers(getattr(line, key))}" for key in keys),
        f"law.level_setpoint={law.level_setpoint:.17g}",
        f"law.slope_margin={law.slope_margin:.17g}",
    )


def judged(line, law, level, density):
    """What the reference says of the same state."""
    state = State.held(line, level, lambda place: profile(density, line.belt_length, place))
    promises = proposition_2(line, law, state), sharper(line, law, state)
    return *promises, starts_compatibly(line, law, state)


def drawn(random):
    """A conveyor that the controller takes, its law and its state, drawn at random."""
    line = Line(
        belt_length=random.uniform(0.8, 3.0),
        processing_time=random.uniform(0.15, 0.4),
        speed_window=random.uniform(0.05, 1.0),
        rework_rate=10.0 ** random.uniform(-2.0, -0.7),
        loss_rate=tuple(random.uniform(0.0, 1.5, 4)),
    )
    law = Law(random.uniform(0.15, 0.45), 1.2, random.uniform(5.0, 25.0))
    return line, law, random.uniform(0.0, 0.6), tuple(random.uniform(0.0, 0.3, 3))


def assert_the_same(found, expected):
    """p1(D) of 20 cells is 1e-4 off at most, which a slope of 33 makes 3e-3 of the law's flux; the
    rework ahead is a sum over ten midpoints, to which 1 % is added for what it may miss (0.7 % at
    most on 60 lines): never less than the reference's; M of the sharper bound is a mean over a
    stretch, not the value at its denser end. All else is float32 and six digits printed."""
    proposition, ahead, jump = found
    assert proposition.flux_min == pytest.approx(expected[0].flux_min, rel=1e-5, abs=3e-3)
    assert proposition.density_max == pytest.approx(expected[0].density_max, rel=1e-5)
    assert proposition.right == pytest.approx(expected[0].right, rel=1e-5)
    if proposition.flux_min > 0.0:
        ratio = proposition.density_max / proposition.flux_min
        assert proposition.left == pytest.approx(ratio, rel=1e-5)
    assert ahead.flux_min == pytest.approx(expected[1].flux_min, rel=1e-5, abs=3e-3)
    assert ahead.right == ahead.flux_min
    assert 1.0 < ahead.left / expected[1].left < 1.02
    assert 0.85 < ahead.density_max / expected[1].density_max < 1.002
    assert jump == pytest.approx(expected[2], abs=5e-3)
    for one, other in zip(found[:2], expected):
        assert one.margin == pytest.approx(one.right / one.left, rel=1e-5)
        assert (one.applies, one.holds) == (other.applies, other.holds)


@pytest.mark.parametrize("program", ["BELT_SIM", "BELT_SIM_F64"])
def test_promises_are_the_references_on_lines_drawn_at_random(program):
    random = np.random.default_rng(2026)
    counts = np.zeros(2, dtype=int)
    for _ in range(20):
        line, law, level, density = drawn(random)
        settings = *settings_of(line, law), *start(level, density)
        found = check("paper", *settings, program=program)
        assert_the_same(found, judged(line, law, level, density))
        counts += [bound.holds for bound in found[:2]]
    assert 20 > counts[1] > counts[0] > 0


@pytest.mark.parametrize("scenario", LINES)
def test_promises_are_the_references_on_shipped_lines(scenario):
    level, density = (0.2, (0.1, 0.3, 0.2)) if scenario == "loaded_line" else (0.0, 0.0)
    assert_the_same(check(scenario), judged(LINES[scenario], Law(), level, density))


def test_promises_do_not_depend_on_the_units():
    """parts_and_minutes is `paper` in hundreds of parts, minutes, feet; six digits are printed."""
    here, there = check("paper"), check("parts_and_minutes")
    for one, other in zip(here[:2], there[:2]):
        assert other.margin == pytest.approx(one.margin, rel=1e-5)
        assert (other.applies, other.holds) == (one.applies, one.holds)


def test_measured_density_is_the_plants_and_else_the_observers():
    told = check("paper", "initial.density=0.3", "initial.observer_density=0.1")
    measured = check("paper_upwind", "initial.density=0.3", "initial.observer_density=0.1")
    assert told[2] == pytest.approx(judged(Line(), Law(), 0.0, 0.1)[2], abs=1e-3)
    assert measured[2] == pytest.approx(judged(Line(), Law(), 0.0, 0.3)[2], abs=1e-3)


def test_advice_that_promises_nothing_refuses_nothing():
    """Nearly full, with much rework: neither bound holds, every rule does."""
    bounds = check("heavy_window", "initial.buffer_level=0.9", "line.rework_rate=0.4")[:2]
    assert [(bound.applies, bound.holds) for bound in bounds] == [(True, False)] * 2
    full = check("paper", "initial.buffer_level=1")[:2]
    assert [(bound.applies, bound.holds) for bound in full] == [(False, False)] * 2
    frozen = check("paper", "controller.law=frozen")[:2]
    assert [(bound.applies, bound.holds) for bound in frozen] == [(False, False)] * 2


def test_without_rework_the_margin_has_no_bound():
    bounds = check("paper", "line.rework_rate=0")[:2]
    assert [bound.holds for bound in bounds] == [True, True]
    assert min(bound.margin for bound in bounds) > 1e38


def test_state_that_the_controller_does_not_take_is_not_judged():
    result = belt_sim("check", "paper", "--set", "initial.observer_density=1e6")
    assert result.returncode == 0
    assert "nothing to judge" in result.stdout and "Proposition" not in result.stdout


def test_broken_rules_get_no_advice():
    result = belt_sim("check", "paper", "--set", "law.level_setpoint=0")
    assert result.returncode == 2
    assert "advice" not in result.stdout
