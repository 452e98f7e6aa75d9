# SPDX-License-Identifier: MIT
"""The coupled integral equations of the predictor, solved as Appendix B solves them.

Each sweep evaluates the right sides on whole arrays with what the last sweep found: successive
approximation, which converges on any length for Volterra equations. A first solution is continued
block by block along the belt, so that no sweep starts far from the answer; one with a guess at
hand needs few sweeps. Integrals are by the trapezoid rule: second order in the node spacing.

Nodes are ascending positions from 0. Two nodes at one position are the two sides of a jump of u,
outlet side first: the strip between them has no width and adds nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference.record import Record

BLOCK = 16  # nodes by which a first solution is continued
SWEEPS = 200  # far more than a contraction needs
TOLERANCE = 1e-13  # of a sweep's last change, relative; rounding makes 1e-15 times the node count


class Nodes:
    """Positions x [m] (N,), and for integrals over y in [0, x] at every node x at once:

    reach x - y [m] (N, N), 0 above the diagonal, and weights [m] (N, N) of the trapezoid rule, so
    that the integral of F(x, y) is (weights*F).sum(axis=1).
    """

    def __init__(self, positions) -> None:
        self.positions = np.asarray(positions, dtype=float)
        self.gaps = np.diff(self.positions)
        half = 0.5 * np.append(self.gaps, 0.0)
        before = 0.5 * np.append(0.0, self.gaps)
        count = len(self.positions)
        self.weights = np.tri(count, k=-1) * (half + before) + np.diag(before)
        self.reach = np.maximum(np.subtract.outer(self.positions, self.positions), 0.0)
        self._tables: dict[Callable, np.ndarray] = {}

    def __len__(self) -> int:
        return len(self.positions)

    def table(self, function: Callable) -> np.ndarray:
        """function(x - y) at all pairs of nodes (N, N), evaluated once."""
        if function not in self._tables:
            values = np.asarray(function(self.reach), dtype=float)
            self._tables[function] = np.broadcast_to(values, self.reach.shape)
        return self._tables[function]

    def first(self, count: int) -> Nodes:
        """The first `count` nodes."""
        return self if count == len(self) else Nodes(self.positions[:count])

    def integral(self, integrand) -> np.ndarray:
        """Integral from 0 to each node of an integrand (..., N) of y alone; same shape."""
        integrand = np.asarray(integrand)
        strips = 0.5 * self.gaps * (integrand[..., 1:] + integrand[..., :-1])
        start = np.zeros((*integrand.shape[:-1], 1))
        return np.concatenate([start, np.cumsum(strips, axis=-1)], axis=-1)


@dataclass(frozen=True)
class Prediction:
    """The layers at the nodes. state p1 (n, N), outlet p2 (N,), window p3 (n, N), arrival sigma
    (N,) [s], speed lambda(p3) (N,) [m/s]."""

    state: np.ndarray
    outlet: np.ndarray
    window: np.ndarray
    arrival: np.ndarray
    speed: np.ndarray

    def extended(self, count: int) -> Prediction:
        """A guess on more nodes: what the last one says goes on."""

        def go_on(values):
            more = count - values.shape[-1]
            return np.concatenate([values, np.repeat(values[..., -1:], more, axis=-1)], axis=-1)

        return Prediction(*map(go_on, vars(self).values()))

    def without_first(self) -> Prediction:
        """The nodes that stay when the first has left the belt."""
        return Prediction(*(values[..., 1:] for values in vars(self).values()))


def close(values, before) -> bool:
    """Whether a sweep changed nothing but rounding."""
    scale = 1.0 + np.max(np.abs(values), initial=0.0)
    return bool(np.max(np.abs(values - before), initial=0.0) < TOLERANCE * scale)


def settle(system, nodes: Nodes, record: Record, outlet_rule, inlet_rule, guess) -> Prediction:
    """Sweep until nothing changes; the costly outlet rule once for several cheap sweeps.

    Raises ArithmeticError when the sweeps overflow or do not settle.
    """
    now, present = record.time, record.state
    state, outlet = guess.state, guess.outlet
    window, arrival, speed = guess.window, guess.arrival, guess.speed
    known = len(nodes) - (inlet_rule is not None)
    for _ in range(SWEEPS):
        before = outlet[:known], speed[:known], state[:, :known]
        outlet = outlet_rule(nodes, state, outlet, speed)
        for _ in range(SWEEPS):
            if inlet_rule is not None:
                outlet[-1] = inlet_rule(state[:, -1], speed[-1])
            last = state, arrival
            arrival = system.arrival_time(nodes, now, speed)
            window = record.window_ahead(arrival, state)
            speed = system.speed(window)
            state = system.predicted_state(nodes, present, state, outlet, speed)
            if close(state, last[0]) and close(arrival, last[1]):
                break
        if not np.all(np.isfinite(state)):
            break
        if all(map(close, (outlet[:known], speed[:known], state[:, :known]), before)):
            return Prediction(state, outlet, window, arrival, speed)
    raise ArithmeticError("the integral equations of the predictor do not settle")


def solve(system, nodes: Nodes, record: Record, outlet_rule, inlet_rule=None, guess=None):
    """The Prediction at the nodes.

    outlet_rule(nodes, state, outlet, speed) -> p2 (N,) from the last sweep's layers;
    inlet_rule(state (n,), speed) -> p2 of the last node, when the law says what is fed there;
    guess: a Prediction on the same nodes to start from.
    """
    if guess is not None:
        return settle(system, nodes, record, outlet_rule, inlet_rule, guess)
    present, window = record.state[:, None], record.window()[:, None]
    speed = np.atleast_1d(system.speed(window))
    guess = Prediction(present, np.zeros(1), window, np.array([record.time]), speed)
    for end in [*range(BLOCK, len(nodes), BLOCK), len(nodes)]:
        last = inlet_rule if end == len(nodes) else None
        guess = settle(system, nodes.first(end), record, outlet_rule, last, guess.extended(end))
    return guess


def outlet_rule_of(system, values) -> Callable:
    """The right side of (equation p_2(x,t)), (MF4) on any first part of the nodes."""

    def rule(part: Nodes, _state, outlet, speed):
        return system.predicted_outlet(part, values[: len(part)], outlet, speed)

    return rule


def predict(system, nodes: Nodes, values, record: Record, guess=None) -> Prediction:
    """p1, p2, p3, sigma for a belt known everywhere: values u(x, t) (N,) at the nodes.

    (equation p_1(x,t))-(equation sig(x,t)) or (MF3)-(MF7), as `system` is of Section 2 or 3.
    Second order in the node spacing.
    """
    rule = outlet_rule_of(system, np.asarray(values, dtype=float))
    return solve(system, nodes, record, rule, guess=guess)


def predict_with_law(system, nodes: Nodes, values, record: Record, guess=None) -> Prediction:
    """The same when the last node, at D, is about to be fed by the law: w(D, t) = 0 gives its p2.

    values u(x, t) (N-1,) at the nodes before it.
    """
    rule = outlet_rule_of(system, np.append(values, np.nan))
    return solve(system, nodes, record, rule, system.outlet_demanded, guess)


def predict_backward(system, nodes: Nodes, target, record: Record, guess=None) -> Prediction:
    """pi1, pi2, pi3, sigma bar from w(x, t) (N,): (pi1)-(pi4) or (npi1)-(npi4)."""
    target = np.asarray(target, dtype=float)

    def rule(part: Nodes, state, _outlet, speed):
        return system.outlet_demanded(state, speed, target[: len(part)])

    return solve(system, nodes, record, rule, guess=guess)


def forward(system, nodes: Nodes, values, record: Record) -> np.ndarray:
    """w(x, t) (N,) of u(x, t) (N,): (backstepping transformation), (nonlinear backstepping)."""
    return system.transformation(nodes, values, predict(system, nodes, values, record))


def inverse(system, nodes: Nodes, target, record: Record) -> np.ndarray:
    """u(x, t) (N,) of w(x, t) (N,): (inverse backstepping transformation), (non inverse
    backstepping)."""
    prediction = predict_backward(system, nodes, target, record)
    return system.inverse_transformation(nodes, target, prediction)


def compatibility(system, positions, values, record: Record) -> float:
    """u0(D) minus what (cu), (nu0) ask for; a front of this height enters when it is not 0.

    positions (N,) [m] from 0 to D, values u0 (N,).
    """
    values = np.asarray(values, dtype=float)
    prediction = predict_with_law(system, Nodes(positions), values[:-1], record)
    control = system.control(Nodes(positions), prediction)
    return float(values[-1] - system.inlet_value(control, prediction.speed[0]))
