# SPDX-License-Identifier: MIT
"""Lemmas 11 and 12 as numbers: bounds that hold, and those printed that do not."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from reference.examples.nonlinear_recycle import CONSTANTS, EXAMPLE
from reference.integral_equations import Nodes, forward, inverse, predict, predict_backward
from reference.norm_equivalence import Constants
from reference.record import Record
from reference.section3 import FluxControl

NODES = Nodes(np.linspace(0.0, 1.0, 61))


def drawn(random, size):
    """A belt and a past whose sizes add up to `size`, drawn at random; (values, record)."""
    share = random.random()
    values = np.cumsum(random.normal(size=61)) + random.normal()
    values *= share * size / np.max(np.abs(values))
    state = (1.0 - share) * size * random.choice([-1.0, 1.0])
    return values, state, Record.of(0.5, lambda time: [state * np.cos(9.0 * time)], 50)


def test_every_step_of_the_estimates_holds_for_data_drawn_at_random():
    random = np.random.default_rng(11)
    system = EXAMPLE.system
    for size in np.geomspace(1e-3, 30.0, 40):
        values, state, record = drawn(random, size)
        sup_u = np.max(np.abs(values))
        result = predict(system, NODES, values, record)
        kernel = system.kernel(NODES, result.speed)
        assert np.nanmax(kernel) <= CONSTANTS.kernel_max  # (K1)
        ratios = np.diagonal(kernel)[:, None] / kernel
        assert np.nanmax(ratios) <= CONSTANTS.kernel_max  # (K2)
        outlet = np.max(np.abs(result.outlet))
        assert outlet <= CONSTANTS.outlet_bound(sup_u)  # (p2norm)
        assert np.max(np.abs(result.state)) <= CONSTANTS.state_bound(abs(state), outlet)  # (p1norm)
        target = system.transformation(NODES, values, result)
        sup_w = np.max(np.abs(target))
        assert sup_w <= CONSTANTS.transformation_bound(abs(state), sup_u)  # (wunorm), corrected
        assert sup_w <= CONSTANTS.transformation_bound(size, size)  # (norm 5), K3(size)
        back = predict_backward(system, NODES, values, record)
        assert np.max(np.abs(back.state)) <= CONSTANTS.stable(abs(state), sup_u)  # (ISSE)
        found = np.max(np.abs(inverse(system, NODES, values, record)))
        assert found <= CONSTANTS.inverse_bound(abs(state), sup_u)  # (lemma13_5)
        assert found <= CONSTANTS.inverse_bound(size, size)  # (norm 6), K4(size)


def test_bounds_are_those_of_the_proofs_by_hand():
    """D = 1, epsilon = 0.5, lambda <= 1.5, Lg = 1.5, G3 = 5 s^2, rho = 2 s; K1 = K2 = k."""
    k = np.exp(3.0 / np.pi)
    outlet = k * 0.2 * np.exp(3.0 * k)
    assert CONSTANTS.outlet_bound(0.2) == pytest.approx(outlet, rel=1e-13)
    state = np.sqrt(np.exp(2.0) * 0.3**2 + np.expm1(2.0) * 5.0 * (1.5 * outlet) ** 2)
    assert CONSTANTS.state_bound(0.3, outlet) == pytest.approx(state, rel=1e-13)
    target = 1.5 * k * 0.2 + 2.0 * state + 1.5 * k / 0.5 * 1.5 * outlet
    assert CONSTANTS.transformation_bound(0.3, 0.2) == pytest.approx(target, rel=1e-13)
    demanded = 0.2 + 2.0 * (0.3 + 0.2 / 1.6)
    value = k / 0.5 * demanded + k * 1.5 / 0.5 * demanded / 0.5
    assert CONSTANTS.inverse_bound(0.3, 0.2) == pytest.approx(value, rel=1e-13)


def test_bounds_are_of_class_k_infinity():
    sizes = np.append(0.0, np.geomspace(1e-6, 1e6, 61))
    for bound in (CONSTANTS.transformation_bound, CONSTANTS.inverse_bound):
        values = bound(sizes, sizes)
        assert values[0] == 0.0 and np.all(np.diff(values) > 0.0) and values[-1] > 1e6


def test_kernel_bounds_are_met_at_the_least_speed():
    nodes = Nodes(np.linspace(0.0, 1.0, 401))
    slow = np.full(401, CONSTANTS.speed_min)
    middle = np.searchsorted(nodes.positions, 0.5)  # up to here c grows what passes
    kernel = EXAMPLE.system.kernel(nodes, slow)
    assert kernel[middle, middle] == pytest.approx(CONSTANTS.kernel_max, rel=1e-4)
    lost = EXAMPLE.system.inverse_kernel(nodes, slow)
    assert lost[-1, middle] == pytest.approx(CONSTANTS.inverse_kernel_max, rel=1e-4)


def free(length, speed, recycle):
    """kappa = 0, no friction, constant speed, g = recycle*v, with its constants."""
    system = FluxControl(
        belt_length=length,
        speed_window=0.5,
        f=lambda X, q: 0.0 * X + 0.0 * q,
        g=lambda x, v: recycle * v + 0.0 * x,
        c=lambda x: 0.0 * x,
        speed=lambda R: speed + 0.0 * R[0],
        kappa=lambda X: 0.0 * X[0],
    )
    constants = replace(
        CONSTANTS,
        belt_length=length,
        speed_min=speed,
        speed_max=speed,
        lipschitz=recycle,
        growth=0.0,
        loss=0.0,
        law_growth=lambda s: 0.0 * s,
    )
    return system, constants


@pytest.mark.parametrize("length, speed, recycle", [(1.0, 5.0, 0.0), (10.0, 1.0, 0.1)])
def test_bound_of_w_as_printed_is_too_small(length, speed, recycle):
    """(wunorm): K1/epsilon where lambda_max*K1 belongs; and the integral's length D is missing."""
    system, constants = free(length, speed, recycle)
    nodes = Nodes(np.linspace(0.0, length, 201))
    record = Record.of(0.5, [0.0], 50)
    sup_w = np.max(np.abs(forward(system, nodes, np.ones(201), record)))
    assert sup_w == pytest.approx(speed * np.exp(recycle * length / speed), rel=1e-4)
    assert sup_w > 1.5 * constants.transformation_bound_as_printed(0.0, 1.0)
    # without recycle the bound is met
    assert sup_w <= constants.transformation_bound(0.0, 1.0) * (1.0 + 1e-12)


def test_comparison_equation_of_lemma_12_can_end_before_the_belt_does():
    """X' = v, kappa = -X - X^3, lambda = D = 1. With Theta = X^2, G3 = s^2, G4 = 4 s^2 and
    rho = s + s^3 the equation (Z(X)) from X = 1, w = 0 blows up, while pi1 never leaves [0, 1]."""
    growth = lambda s: s + s**3  # noqa: E731

    def slope(_z, x):  # dx/dz: how far along the belt z is
        return 1.0 / (_z + 4.0 * growth(np.sqrt(_z)) ** 2) + 0.0 * x

    reached = solve_ivp(slope, (1.0, 1e6), [0.0]).y[0, -1]
    # beyond z = 1e6 what is left is less than the integral of 1/(4 z^3)
    assert reached < 0.1
    system, _ = free(1.0, 1.0, 0.0)
    system = replace(system, f=lambda X, q: 0.0 * X + q, kappa=lambda X: -growth(X[0]))
    result = predict_backward(system, NODES, np.zeros(61), Record.of(0.5, [1.0], 50))
    assert np.max(np.abs(result.state)) == 1.0


def test_gain_cannot_leave_its_function():
    """G3(lambda s) <= lambda_1 G3(s) fails for G3 = exp - 1: the ratio has no bound."""
    sizes = np.array([1.0, 10.0, 100.0])
    ratio = np.expm1(2.0 * sizes) / np.expm1(sizes)
    assert np.all(np.diff(ratio) > 0.0) and ratio[-1] > 1e40
    assert isinstance(CONSTANTS, Constants)
