# SPDX-License-Identifier: MIT
"""Claims about Proposition 2: what it promises happens, in any units, and its print does not."""

from dataclasses import replace

import numpy as np
import pytest

from reference.line import Law, Line
from reference.mixed_loop import simulate
from reference.nominal_law import nominal_law
from reference.safety import (
    State,
    crowding_max,
    predicted,
    proposition_2,
    right_as_printed,
    sharper,
    starts_compatibly,
)
from reference.section4 import conveyor

HEAVY = Line(speed_window=3.0)


def flux_min(line, law, level, density=0.0, node_count=30):
    """Least U of the closed loop without limits [parts/s], over five transits of a line at Q*."""
    crowded = 1.0 + law.level_setpoint * line.speed_window
    duration = 5.0 * line.processing_time * line.belt_length * crowded
    trace = simulate(conveyor(line, law), np.array([level]), density, duration, node_count)
    return float(np.min(trace.control))


def test_papers_case_and_the_heavy_window_by_hand():
    promise = proposition_2(Line(), Law(), State.held(Line(), 0.0))
    density_max = 0.25 * 1.2**2 * 1.2 * np.exp(2 * 0.1 * 0.25 * 4 * 1.2)
    assert promise.density_max == pytest.approx(density_max, rel=1e-13)
    assert promise.flux_min == pytest.approx(0.6, rel=1e-12)
    assert promise.left == pytest.approx(density_max / 0.6, rel=1e-12)
    assert promise.right == pytest.approx(2 / (0.1 * 4 * 1.2), rel=1e-13)
    assert promise.holds and promise.margin == pytest.approx(4.55, abs=0.01)
    heavy = proposition_2(HEAVY, Law(), State.held(HEAVY, 0.0))
    assert heavy.left == pytest.approx(17.80, abs=0.01)
    assert heavy.right == pytest.approx(1.25, rel=1e-13) and not heavy.holds
    # printed, it passes by the accident of its units; what happens is far from negative
    assert heavy.left < right_as_printed(HEAVY) == pytest.approx(40.0, rel=1e-13)
    assert flux_min(HEAVY, Law(), 0.0) > 1.16


def test_sharper_bound_promises_the_heavy_window_too():
    light = sharper(Line(), Law(), State.held(Line(), 0.0))
    heavy = sharper(HEAVY, Law(), State.held(HEAVY, 0.0))
    assert light.holds and heavy.holds
    assert light.margin > 2.0 * proposition_2(Line(), Law(), State.held(Line(), 0.0)).margin
    # M of the empty line: everything to come was fed by the law, at P*(1 + tau*Q*)*Bmax
    assert heavy.density_max == pytest.approx(0.25 * (1.0 + 3.0 * 0.3) * 1.2, rel=1e-12)
    # left by hand: A*M * integral of y*exp(-P*C*(D - y)) over [0, D], s_low = 1, ratio 1
    rate = 0.25
    integral = 2.0 / rate - (1.0 - np.exp(-rate * 2.0)) / rate**2
    assert heavy.left == pytest.approx(0.1 * heavy.density_max * integral, rel=1e-4)


UNITS = [(100.0, 1.0, 1.0), (1.0, 1 / 60, 1.0), (1.0, 1.0, 3.28), (250.0, 60.0, 0.01)]


def rescaled(line, law, parts, seconds, metres):
    """The same line and law written in other units."""
    return replace(
        line,
        belt_length=line.belt_length * metres,
        processing_time=line.processing_time * seconds / metres,
        speed_window=line.speed_window * seconds,
        congestion_scale=line.congestion_scale * parts * seconds,
        service_rate_max=line.service_rate_max * parts / seconds,
        service_time=line.service_time * seconds,
        level_capacity=line.level_capacity * parts,
        rework_rate=line.rework_rate / metres / seconds,
        loss_rate=tuple(value / seconds for value in line.loss_rate),
    ), replace(
        law,
        level_setpoint=law.level_setpoint * parts,
        nominal_flux_max=law.nominal_flux_max * parts / seconds,
        slope_margin=law.slope_margin / seconds,
    )


@pytest.mark.parametrize("parts, seconds, metres", UNITS)
def test_promises_do_not_depend_on_the_units_and_the_printed_one_does(parts, seconds, metres):
    line, law = replace(HEAVY, loss_rate=(0.5, 1.0, 0.2)), Law()
    there_line, there_law = rescaled(line, law, parts, seconds, metres)
    here = State.held(line, 0.35, 0.2)
    there = State.held(there_line, 0.35 * parts, 0.2 * parts / metres)
    for bound in (proposition_2, sharper):
        before, after = bound(line, law, here), bound(there_line, there_law, there)
        assert after.margin == pytest.approx(before.margin, rel=1e-9)
        assert after.flux_min * seconds / parts == pytest.approx(before.flux_min, rel=1e-9)
        assert after.density_max * metres / parts == pytest.approx(before.density_max, rel=1e-9)
    mismatch = starts_compatibly(there_line, there_law, there) * metres / parts
    assert mismatch == pytest.approx(starts_compatibly(line, law, here), rel=1e-8)
    ratio = proposition_2(there_line, there_law, there).left / right_as_printed(there_line)
    before = proposition_2(line, law, here).left / right_as_printed(line)
    # s/m over m^2/s: (seconds/metres)/(metres^2/seconds)
    assert ratio / before == pytest.approx(seconds**2 / metres**3, rel=1e-9)


def drawn(random):
    """A conveyor, its law and its state, drawn at random; recycle up to ten times the paper's."""
    losses = tuple(random.uniform(0.0, 1.5, 4))
    line = Line(
        belt_length=random.uniform(0.5, 3.0),
        processing_time=random.uniform(0.1, 0.4),
        speed_window=random.uniform(0.05, 3.0),
        rework_rate=10.0 ** random.uniform(-2.0, 0.3),
        loss_rate=losses,
    )
    law = Law(random.uniform(0.15, 0.45), 1.2, random.uniform(5.0, 25.0))
    level, density = random.uniform(0.0, 0.6), random.uniform(0.0, 0.3)
    return line, law, level, density


def test_what_is_promised_happens_on_lines_drawn_at_random():
    """The map of promise against simulation, as counts: no promise is broken, and the sharper
    bound makes several times as many."""
    random = np.random.default_rng(16)
    counts = {"safe": 0, "proposition": 0, "sharper": 0}
    for _ in range(25):
        line, law, level, density = drawn(random)
        state = State.held(line, level, density, 40)
        safe = flux_min(line, law, level, density, node_count=20) > 0.0
        promised = proposition_2(line, law, state), sharper(line, law, state)
        for promise in promised:
            assert safe or not promise.holds
            assert promise.applies
        # each bound of its own kind: what p2 is now is not above the M of either
        outlet = np.max(predicted(line, law, state).outlet)
        assert all(outlet <= promise.density_max for promise in promised)
        counts["safe"] += safe
        counts["proposition"] += promised[0].holds
        counts["sharper"] += promised[1].holds
    assert counts["safe"] > counts["sharper"] > 2 * counts["proposition"] > 0


def test_state_that_the_proposition_does_not_cover_gets_no_promise():
    line = Line()
    full = State.held(line, line.level_capacity)
    assert not proposition_2(line, Law(), full).holds and not sharper(line, Law(), full).applies
    crowded = State.held(line, 0.9, 1.2)  # the level predicted leaves the buffer
    assert 1.0 < predicted(line, Law(), crowded).state[0, -1] < 1.5
    assert not proposition_2(line, Law(), crowded).applies
    debt = State.held(line, 0.2, lambda x: 0.1 - 0.2 * (x > 1.0))
    assert not sharper(line, Law(), debt).applies


def test_without_rework_nothing_can_turn_the_flux():
    line = Line(rework_rate=0.0)
    for bound in (proposition_2, sharper):
        promise = bound(line, Law(), State.held(line, 0.1))
        assert promise.holds and promise.margin == np.inf


def test_least_nominal_flux_is_that_of_the_highest_level_to_come():
    line = Line()
    state = State.held(line, 0.2, 0.5)
    last = predicted(line, Law(), state).state[0, -1]
    assert last > 0.35
    expected = nominal_law(line, Law()).flux(last)
    assert proposition_2(line, Law(), state).flux_min == pytest.approx(expected, rel=1e-12)
    assert sharper(line, Law(), state).flux_min == pytest.approx(expected, rel=1e-12)
    # above the set-point now, falling below: u at the present level, which only the paper takes
    high = State.held(line, 0.5, 0.0)
    assert proposition_2(line, Law(), high).flux_min < sharper(line, Law(), high).flux_min
    assert crowding_max(line) == pytest.approx(1.2)


def test_compatible_belt_lets_no_front_in():
    """(nu0) of the paper's own start is off by all that U(0) = 1.98 feeds."""
    mismatch = starts_compatibly(Line(), Law(), State.held(Line(), 0.0))
    assert mismatch == pytest.approx(-1.978 * 0.25, abs=1e-3)


def test_jump_is_of_second_order_in_the_nodes():
    """A front of no width: smeared over the last strip it would be of first order."""
    line = Line(loss_rate=(1.1, 0.1, 1.0, 0.5))
    jumps = [starts_compatibly(line, Law(), State.held(line, 0.25, 0.2, n)) for n in (25, 50, 100)]
    # 4 of the second order, 2 of the first
    assert (jumps[0] - jumps[1]) / (jumps[1] - jumps[2]) == pytest.approx(4.0, abs=0.2)


def test_a_falling_level_weighs_by_its_deepest_fall():
    """`sharper` goes over from a level that only rises to one that falls without a step."""
    line = Line(rework_rate=0.3)
    levels = np.array([0.25, 0.25 + 1e-9, 0.25 - 1e-9])
    lefts = [sharper(line, Law(), State.held(line, level, 0.3)).left for level in levels]
    assert lefts == pytest.approx([lefts[0]] * 3, rel=1e-7)
    falling = sharper(line, Law(), State.held(line, 0.4))
    lowest = predicted(line, Law(), State.held(line, 0.4)).state[0].min()
    fed = 0.25 * (1.0 + 0.2 * 0.4) * nominal_law(line, Law()).flux(lowest)
    rate = 0.25 * (1.0 + 0.2 * lowest)
    integral = 2.0 / rate - (1.0 - np.exp(-rate * 2.0)) / rate**2
    ratio = 1.0 + 0.2 * (0.4 - lowest) / (1.0 + 0.2 * lowest)
    assert falling.left == pytest.approx(0.3 * fed * ratio * integral, rel=1e-4)
