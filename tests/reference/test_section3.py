# SPDX-License-Identifier: MIT
"""Claims about Section 3: kernels, the law, the transformations, and how the sections meet."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import CubicSpline

from reference.examples.nonlinear_recycle import EXAMPLE
from reference.integral_equations import (
    Nodes,
    compatibility,
    forward,
    inverse,
    predict,
    predict_backward,
    predict_with_law,
)
from reference.record import Record
from reference.section2 import BoundaryControl
from reference.section3 import FluxControl

SYSTEM = EXAMPLE.system
JUMP = np.concatenate([np.linspace(0.0, 0.6, 61), np.linspace(0.6, 1.0, 41)])


def past():
    return Record.of(SYSTEM.speed_window, lambda time: [0.8 + time], 400)


def belt(positions):
    values = 0.4 + 0.3 * np.sin(3.0 * positions)
    values[len(positions) * 61 // 102 :] -= 0.5
    return values


def test_kernel_is_the_exponential_of_the_friction_met():
    nodes = Nodes(np.linspace(0.0, 1.0, 401))
    speed = 1.0 + 0.4 * np.sin(2.0 * nodes.positions)
    kernel = SYSTEM.kernel(nodes, speed)

    def exponent(upper, lower):
        rate = lambda z: SYSTEM.c(upper - z) / (1.0 + 0.4 * np.sin(2.0 * z))  # noqa: E731
        return quad(rate, 0.0, lower)[0]

    for row, column in ((400, 400), (400, 120), (200, 200), (250, 10)):
        places = nodes.positions[row], nodes.positions[column]
        assert kernel[row, column] == pytest.approx(
            np.exp(exponent(*places)), rel=1e-5
        )  # 2nd order
    assert np.isnan(kernel[0, 1:]).all() and np.all(kernel[:, 0] == 1.0)
    assert kernel[200, 200] > 1.3 and kernel[400, 400] < kernel[200, 200]  # c changes sign


def test_inverse_kernel_is_one_over_the_kernel():
    """L of (kernel L) against K of (MF7): where pi3 = p3, L = 1/K."""
    nodes = Nodes(np.linspace(0.0, 1.0, 41))
    speed = 1.0 + 0.4 * np.sin(2.0 * nodes.positions)
    product = SYSTEM.kernel(nodes, speed) * SYSTEM.inverse_kernel(nodes, speed)
    assert product[np.tri(41, dtype=bool)] == pytest.approx(1.0, rel=1e-14)


def test_constant_friction_and_speed_have_a_closed_form():
    """u_t = v u_x + g u(0) + c u, all constant: p2 solves p2 = e^(c x/v) u + a Volterra integral
    whose solution for constant u is known."""
    system = replace(
        SYSTEM,
        g=lambda x, v: 0.7 * v + 0.0 * x,
        c=lambda x: -0.5 + 0.0 * x,
        speed=lambda R: 2.0 + 0.0 * R[0],
    )
    nodes = Nodes(np.linspace(0.0, 1.0, 401))
    result = predict(system, nodes, np.ones(401), past())
    # p2' = (c p2 + g p2)/v, since d/dx of the integral equation is that for constant u
    expected = np.exp((0.7 - 0.5) / 2.0 * nodes.positions)
    assert result.outlet == pytest.approx(expected, rel=1e-6)


def test_control_puts_on_the_belt_what_the_march_wants_to_find():
    """(MF1) is (MF4) at D solved for u: with U on the belt p2(D) = kappa(p1(D))/lambda(p3(D))."""
    values = belt(JUMP)
    nodes = Nodes(np.append(JUMP, 1.0))
    planned = predict_with_law(SYSTEM, nodes, values, past())
    control = SYSTEM.control(nodes, planned)
    fed = SYSTEM.inlet_value(control, planned.speed[0])
    found = predict(SYSTEM, nodes, np.append(values, fed), past())
    demanded = SYSTEM.kappa(found.state[:, -1]) / found.speed[-1]
    assert found.outlet[-1] == pytest.approx(demanded, rel=1e-12)
    target = SYSTEM.transformation(nodes, np.append(values, fed), found)
    assert abs(target[-1]) < 1e-12


def test_compatible_belt_is_one_whose_target_vanishes_at_the_inlet():
    """(nu0): taking the mismatch off u0(D) leaves none, and w(D, 0) = 0."""
    values = belt(JUMP)
    mismatch = compatibility(SYSTEM, JUMP, values, past())
    assert mismatch > 1.0
    values[-1] -= mismatch
    assert abs(compatibility(SYSTEM, JUMP, values, past())) < 1e-12
    assert abs(forward(SYSTEM, Nodes(JUMP), values, past())[-1]) < 1e-12


def test_backward_layers_are_the_forward_ones():
    """(pp), (ssi): pi = p, sigma bar = sigma, where w is the transform of u."""
    nodes, values = Nodes(JUMP), belt(JUMP)
    ahead = predict(SYSTEM, nodes, values, past())
    back = predict_backward(SYSTEM, nodes, SYSTEM.transformation(nodes, values, ahead), past())
    for name in vars(ahead):
        assert np.max(np.abs(getattr(ahead, name) - getattr(back, name))) < 1e-12, name


def test_target_is_what_arrives_above_what_the_law_wants():
    """w = lambda(p3)*p2 - kappa(p1), from (MF4) and (nonlinear backstepping)."""
    nodes, values = Nodes(JUMP), belt(JUMP)
    result = predict(SYSTEM, nodes, values, past())
    target = SYSTEM.transformation(nodes, values, result)
    expected = result.speed * result.outlet - SYSTEM.kappa(result.state)
    assert target == pytest.approx(expected, abs=1e-13)


def test_inverse_on_other_nodes_comes_back_at_second_order():
    """w found on one grid, u found back on another: not the discrete pair, but the formulas."""
    profile = lambda x: 0.4 + 0.3 * np.sin(3.0 * x)  # noqa: E731
    errors = []
    for count in (100, 200):
        coarse, fine = (np.linspace(0.0, 1.0, size * count + 1) for size in (1, 3))
        target = forward(SYSTEM, Nodes(coarse), profile(coarse), past())
        back = inverse(SYSTEM, Nodes(fine), CubicSpline(coarse, target)(fine), past())
        errors.append(np.max(np.abs(back - profile(fine))))
    assert errors[1] < 2e-5
    assert 3.5 < errors[0] / errors[1] < 4.5


def test_march_is_second_order_across_a_jump():
    def answer(scale):
        left, right = np.linspace(0.0, 0.6, 6 * scale + 1), np.linspace(0.6, 1.0, 4 * scale + 1)
        values = np.concatenate([np.cos(left), 2.0 + right])
        result = predict(SYSTEM, Nodes(np.concatenate([left, right])), values, past())
        return np.array([result.state[0, -1], result.outlet[-1], result.arrival[-1]])

    exact = (4.0 * answer(24) - answer(12)) / 3.0
    coarse, fine = np.abs(answer(3) - exact), np.abs(answer(6) - exact)
    assert np.all(coarse / fine > 3.3) and np.all(fine < 2e-3)


def test_cold_and_warm_marches_agree():
    nodes, values = Nodes(JUMP), belt(JUMP)
    cold = predict(SYSTEM, nodes, values, past())
    guess = predict(SYSTEM, nodes, values + 0.3, past())
    warm = predict(SYSTEM, nodes, values, past(), guess)
    for name in vars(cold):
        assert np.max(np.abs(getattr(cold, name) - getattr(warm, name))) < 1e-12, name


def test_without_friction_and_at_unit_speed_flux_control_is_boundary_control():
    """lambda = 1, c = 0, g(x)v: both sections say the same, law and transformations."""
    recycle = lambda x: 0.6 * np.cos(2.0 * x)  # noqa: E731
    shared = {"belt_length": 1.0, "speed_window": 0.5, "f": SYSTEM.f, "kappa": SYSTEM.kappa}
    shared["speed"] = lambda R: 1.0 + 0.0 * R[0]
    boundary = BoundaryControl(g=recycle, **shared)
    flux = FluxControl(g=lambda x, v: recycle(x) * v, c=lambda x: 0.0 * x, **shared)
    nodes, values = Nodes(JUMP), belt(JUMP)
    results = [predict(system, nodes, values, past()) for system in (boundary, flux)]
    assert results[0].state == pytest.approx(results[1].state, abs=1e-13)
    assert results[0].outlet == pytest.approx(results[1].outlet, abs=1e-13)
    controls = [system.control(nodes, results[0]) for system in (boundary, flux)]
    assert controls[0] == pytest.approx(controls[1], rel=1e-13)
    targets = [forward(system, nodes, values, past()) for system in (boundary, flux)]
    assert targets[0] == pytest.approx(targets[1], abs=1e-12)
    backs = [inverse(system, nodes, values, past()) for system in (boundary, flux)]
    assert backs[0] == pytest.approx(backs[1], abs=1e-12)


def test_length_and_window_must_be_positive():
    for change in ({"belt_length": -1.0}, {"speed_window": 0.0}):
        with pytest.raises(ValueError, match="positive"):
            replace(SYSTEM, **change)
