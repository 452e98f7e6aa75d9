# SPDX-License-Identifier: MIT
"""Claims about Section 2: the window weight, the delay maps, the special cases."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad, simpson
from scipy.linalg import expm

from reference.examples.pendulum import EXAMPLE as PENDULUM
from reference.examples.unstable_scalar import EXAMPLE as SCALAR
from reference.integral_equations import Nodes, compatibility, forward, predict
from reference.mixed_loop import Compensated, Plant, Uncompensated, simulate, simulate_extrapolated
from reference.record import Record
from reference.section2 import BoundaryControl, Characteristics, delayed_outlet, gamma


def record(window=0.5, late=0.0):
    times = np.linspace(-window, 0.0, 201)
    return Record(window, times + late, np.stack([np.cos(3.0 * times), times**2]))


def test_window_layer_is_the_two_integrals_with_gamma():
    """(equation p_3(x,t)) read literally: gamma under both integrals, by a fine midpoint sum."""
    past, window = record(), 0.5
    positions = np.linspace(0.0, 1.0, 201)
    speed = 1.0 + 0.3 * np.cos(4.0 * positions)
    nodes = Nodes(positions)
    arrival = nodes.integral(1.0 / speed)
    state = past.state[:, None] + np.stack([np.sin(arrival), 0.4 * arrival])
    layer = past.window_ahead(arrival, state)
    middles = (np.arange(100000) + 0.5) / 100000
    for node in (0, 30, 90, 200):
        instants = (middles - 1.0) * window
        recorded = np.stack([np.interp(instants, past.times, row) for row in past.states])
        first = np.mean(gamma(instants, arrival[node], window) * recorded, axis=1) * window
        places = middles * positions[node]
        inside = gamma(np.interp(places, positions, arrival), arrival[node], window)
        states = np.stack([np.interp(places, positions, row) for row in state])
        rate = states / np.interp(places, positions, speed)
        second = np.mean(inside * rate, axis=1) * positions[node]
        # the edge of gamma within one of the strips of 1e-5, and 1/lambda linear in neither: 1e-5
        assert layer[:, node] == pytest.approx(first + second, abs=3e-5)
    assert arrival[-1] > window  # the window has left the record behind, (eq:p30_advanced)


def test_gamma_is_one_on_the_closed_window_only():
    instants = np.array([-0.6, -0.5, -0.2, 0.0, 0.1])
    assert gamma(instants, 0.0, 0.5).tolist() == [0.0, 1.0, 1.0, 1.0, 0.0]


def test_record_grows_and_does_not_depend_on_the_clock():
    past = Record.of(0.5, lambda time: [1.0 + time])
    assert past.window() == pytest.approx([0.375], rel=1e-12)
    for count in range(1, 2001):
        past.append(1e-3 * count, np.array([1.0 + 1e-3 * count]))
    assert past.window() == pytest.approx([2.75 * 0.5], rel=1e-12)
    early, late = record(), record(late=1e4)
    arrival, state = np.array([0.0, 0.3, 0.7]), np.array([[1.0, 0.5, 0.2], [0.0, 0.1, 0.2]])
    there = late.window_ahead(arrival + 1e4, state)
    assert there == pytest.approx(early.window_ahead(arrival, state), abs=1e-9)


@pytest.fixture(scope="module")
def scalar_run():
    """The scalar plant from a start that is compatible: no jump travels down the belt."""
    past = Record.of(SCALAR.system.speed_window, SCALAR.history)
    positions = np.linspace(0.0, 1.0, 101)

    def mismatch(rise):
        values = SCALAR.profile(positions) + rise * positions**2
        return compatibility(SCALAR.system, positions, values, past)

    rise = 0.0
    for _ in range(40):  # p1(D) feels the rise weakly
        rise -= 0.5 * mismatch(rise)
    profile = lambda x: SCALAR.profile(x) + rise * x**2  # noqa: E731
    return simulate(SCALAR.system, SCALAR.history, profile, 4.0, 100, keep_belts=True)


def test_compatible_start_feeds_what_lies_at_the_inlet(scalar_run):
    """(cu): u0(D) is what the law feeds, and the target starts at 0 there."""
    positions, values = scalar_run.belts[0]
    assert values[-1] == pytest.approx(values[-2], abs=1e-9)
    past = Record.of(SCALAR.system.speed_window, SCALAR.history)
    target = forward(SCALAR.system, Nodes(positions[:-1]), values[:-1], past)
    assert abs(target[-1]) < 1e-9


def test_worked_examples_start_incompatibly():
    past = Record.of(0.6, PENDULUM.history)
    mismatch = compatibility(PENDULUM.system, np.linspace(0.0, 1.0, 51), np.zeros(51), past)
    assert mismatch > 0.1  # what was not fed: the law asks for a negative input


def test_delay_maps_are_the_arrivals_of_the_march_and_each_other_backwards(scalar_run):
    trace, length = scalar_run, SCALAR.system.belt_length
    curves = trace.characteristics()
    fed = trace.distance < trace.distance[-1] - length
    times = trace.time[fed]
    leaves = curves.leaves(length, times)
    # the march's sigma is of the rule's second order, the cubic's integral of lambda of fourth
    assert np.max(np.abs(leaves - trace.predicted.arrival[fed])) < 2e-5
    assert np.max(np.abs(curves.entered(0.0, leaves, length) - times)) < 1e-7  # (dp)
    assert curves.curve(1.3, 0.4, 1.3) == pytest.approx(0.4, rel=1e-12)
    # zeta falls at lambda: (cline)
    moved = quad(lambda time: np.interp(time, trace.time, trace.speed), 1.0, 1.4, limit=200)[0]
    assert curves.curve(1.4, 0.9, 1.0) == pytest.approx(0.9 - moved, abs=1e-5)
    assert np.isnan(curves.entered(0.0, 0.1, length))  # fed before the run began


def test_outlet_is_the_delayed_control_plus_the_recycle_on_the_way(scalar_run):
    """(apu0), from the record of U and u(0, .) alone."""
    trace = scalar_run
    curves = trace.characteristics()
    for time in (1.6, 2.3, 3.5):
        columns = trace.time, trace.control, trace.outlet
        expected = delayed_outlet(SCALAR.system, curves, *columns, time)
        actual = np.interp(time, trace.time, trace.outlet)
        assert actual == pytest.approx(expected, abs=1e-4)  # trapezoid at 10 ms, and linear U
    assert (
        abs(expected - np.interp(curves.entered(0.0, time, 1.0), trace.time, trace.control)) > 1e-3
    )


# ---- Special cases ----

TURN = np.array([[0.0, 1.0], [1.0, 0.3]])
PUSH = np.array([0.0, 1.0])
GAIN = np.array([-4.0, -3.0])


def linear(speed=2.0):
    """X' = TURN X + PUSH v behind a constant delay of D/speed, no source."""
    return BoundaryControl(
        belt_length=1.0,
        speed_window=0.4,
        f=lambda X, v: np.tensordot(TURN, X, 1) + np.multiply.outer(PUSH, v),
        g=lambda x: 0.0 * x,
        speed=lambda R: speed + 0.0 * R[0],
        kappa=lambda X: np.tensordot(GAIN, X, 1),
    )


def test_constant_speed_without_recycle_is_artsteins_predictor():
    """p1(D) = e^(A h) X + integral of e^(A (h - s)) B U(t - h + s): the reduction of Artstein."""
    delay, positions = 0.5, np.linspace(0.0, 1.0, 801)
    past = Record.of(0.4, np.array([0.3, -0.2]))
    values = np.cos(5.0 * positions)
    result = predict(linear(), Nodes(positions), values, past)
    expected = expm(TURN * delay) @ past.state
    instants = np.linspace(0.0, delay, 2001)
    fed = np.stack([expm(TURN * (delay - s)) @ PUSH * np.cos(10.0 * s) for s in instants])
    expected += simpson(fed, x=instants, axis=0)
    assert result.state[:, -1] == pytest.approx(
        expected, abs=5e-7
    )  # second order at 0.6 ms: 2.5e-7
    assert result.arrival == pytest.approx(positions / 2.0, abs=1e-12)  # sigma = t + x/v
    assert result.outlet == pytest.approx(values, rel=1e-14)  # nothing is added on the way
    assert linear().control(Nodes(positions), result) == pytest.approx(GAIN @ result.state[:, -1])


def test_smith_and_artstein_loops_are_the_delay_free_loop_shifted():
    system = linear()
    trace = simulate(system, np.array([1.0, 0.0]), 0.0, 4.0, 100)
    closed = TURN + np.outer(PUSH, GAIN)
    late = trace.time >= 0.5
    start = expm(TURN * 0.5) @ [1.0, 0.0]
    exact = np.stack([expm(closed * (time - 0.5)) @ start for time in trace.time[late]], axis=1)
    assert np.max(np.abs(trace.state[:, late] - exact)) < 2e-4  # second order at 5 ms
    bare = simulate(system, np.array([1.0, 0.0]), 0.0, 4.0, 100, Uncompensated(system))
    assert np.max(np.abs(bare.state[:, -1])) > 10.0 * np.max(np.abs(trace.state[:, -1]))


def test_without_recycle_two_layers_are_left():
    """g = 0: p2 is u itself, (boundary control) is kappa(p1(D)), w is u - kappa(p1)."""
    system = replace(PENDULUM.system, g=lambda x: 0.0 * x)
    past = Record.of(0.6, PENDULUM.history)
    nodes = Nodes(np.linspace(0.0, 1.0, 81))
    values = np.sin(4.0 * nodes.positions)
    result = predict(system, nodes, values, past)
    assert np.array_equal(result.outlet, values)
    demanded = system.kappa(result.state)
    assert system.control(nodes, result) == pytest.approx(demanded[-1], rel=1e-13)
    target = system.transformation(nodes, values, result)
    assert target == pytest.approx(values - demanded, abs=1e-13)


def test_law_recovers_where_the_plant_is_not_its_model():
    """Each march starts from the measured state: a plant of another friction is still held."""
    wrong = replace(PENDULUM.system, f=lambda X, v: 0.97 * PENDULUM.system.f(X, v))
    trace = simulate(wrong, PENDULUM.history, 0.0, 8.0, 40, Compensated(PENDULUM.system))
    assert np.max(np.abs(trace.state[:, -1])) < 0.05


# ---- Refusals ----


def test_length_and_window_must_be_positive():
    for change in ({"belt_length": 0.0}, {"speed_window": -1.0}):
        with pytest.raises(ValueError, match="positive"):
            replace(SCALAR.system, **change)


def test_only_an_even_node_count_can_be_halved():
    with pytest.raises(ValueError, match="odd"):
        simulate_extrapolated(SCALAR.system, SCALAR.history, 0.0, 1.0, 41)


def test_any_function_of_the_plant_is_a_law():
    """Left alone, the pendulum falls as its own equation says."""
    trace = simulate(PENDULUM.system, PENDULUM.history, 0.0, 1.0, 40, lambda plant: 0.0)
    assert trace.predicted is None
    angle, rate = trace.state
    energy = 0.5 * rate**2 + 2.0 * np.cos(angle)
    lost = np.append(0.0, np.cumsum(0.1 * (rate[1:] ** 2 + rate[:-1] ** 2) * np.diff(trace.time)))
    assert energy + lost == pytest.approx(energy[0], abs=2e-4)  # second order at 20 ms


def test_values_that_overflow_are_an_error_and_not_an_answer():
    system = replace(SCALAR.system, f=lambda X, v: 1e3 * X**3 + v)
    with np.errstate(all="ignore"), pytest.raises(ArithmeticError, match="settle"):
        predict(system, Nodes(np.linspace(0.0, 1.0, 41)), np.ones(41), Record.of(0.5, [1.0]))
    plant = Plant(system, [1.0], 0.0, 10)
    with np.errstate(all="ignore"), pytest.raises(ArithmeticError, match="settle"):
        plant.advance()


def test_characteristics_take_a_time_that_stands_twice():
    times = np.array([0.0, 1.0, 1.0, 2.0])
    curves = Characteristics(times, 2.0 * times, np.full(4, 2.0))
    assert curves.curve(2.0, 3.0, 1.0) == pytest.approx(1.0, rel=1e-13)
    assert curves.entered(1.0, 1.5, 3.0) == pytest.approx(0.5, rel=1e-13)
