# SPDX-License-Identifier: MIT
"""Section 2: boundary control, linear recycle. Equation by equation, in the order of the paper.

    X'(t) = f(X(t), u(0, t))                                  (equation X)
    u_t = lambda(R(t)) u_x + g(x) u(0, t),  u(D, t) = U(t)    (equation u), (boundary condition)
    R(t) = integral of X over [t - tau, t]

Arrays: a state has its components first, then places or instants, (n, N); everything else is (N,).
f, speed and kappa take such arrays and must work on them element by element: X[0], X[1], ... are
the components whether X is one state or a belt of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from reference.integral_equations import Nodes, Prediction

# ---- Problem statement, control law and transformations ----


def gamma(instant, end, speed_window: float) -> np.ndarray:
    """gamma(s, t): 1 where t - tau <= s <= t, else 0 (W). Any shapes that broadcast; [s]."""
    return np.where((end - speed_window <= instant) & (instant <= end), 1.0, 0.0)


@dataclass(frozen=True)
class BoundaryControl:
    """A system of Section 2.

    belt_length D [m], speed_window tau [s]; f(X, v) [X per s]: (n, ...), (...) -> (n, ...);
    g(x) [1/s]; speed(R), the paper's lambda [m/s]: (n, ...) -> (...), within two positive bounds
    (eqlam); kappa(X): (n, ...) -> (...). Raises ValueError for a length or window not positive.
    """

    belt_length: float
    speed_window: float
    f: Callable
    g: Callable
    speed: Callable
    kappa: Callable

    def __post_init__(self) -> None:
        if not (self.belt_length > 0.0 and self.speed_window > 0.0):
            raise ValueError("belt_length and speed_window must be positive")

    # what the plant asks of either section

    def ode_input(self, _speed, outlet):
        """What enters f: u(0, t) itself (equation X)."""
        return outlet

    def source(self, position, outlet):
        """g(x) u(0, t) of (equation u), any shape."""
        return self.g(position) * outlet

    def friction(self, position):
        """There is no c(x) u in (equation u)."""
        return np.zeros(np.shape(position))

    def inlet_value(self, control, _speed):
        """u(D, t) = U(t) (boundary condition)."""
        return control

    # the predictor

    def predicted_state(self, nodes: Nodes, present, state, outlet, speed) -> np.ndarray:
        """Right side of (equation p_1(x,t)): X(t) (n,) and the layers at the nodes; (n, N)."""
        return present[:, None] + nodes.integral(self.f(state, outlet) / speed)

    def predicted_outlet(self, nodes: Nodes, values, outlet, speed) -> np.ndarray:
        """Right side of (equation p_2(x,t)); (N,)."""
        return values + self.recycled(nodes, outlet, speed)

    def recycled(self, nodes: Nodes, outlet, speed) -> np.ndarray:
        """The integral of g(x - y) p2(y)/lambda(p3(y)) over y in [0, x], at each x; (N,)."""
        return (nodes.weights * nodes.table(self.g)) @ (outlet / speed)

    def arrival_time(self, nodes: Nodes, now: float, speed) -> np.ndarray:
        """sigma [s] (equation sig(x,t)); (N,)."""
        return now + nodes.integral(1.0 / speed)

    def outlet_demanded(self, state, _speed, target=0.0):
        """p2 where w is `target`: w + kappa(p1) (pi2)."""
        return target + self.kappa(state)

    def control(self, nodes: Nodes, prediction: Prediction) -> float:
        """U(t) (boundary control); the last node is at D."""
        outlet, speed = prediction.outlet, prediction.speed
        reach = self.belt_length - nodes.positions
        recycled = nodes.weights[-1] @ (self.g(reach) * outlet / speed)
        return float(self.kappa(prediction.state[:, -1]) - recycled)

    def transformation(self, nodes: Nodes, values, prediction: Prediction) -> np.ndarray:
        """w(x, t) (backstepping transformation); values u (N,); (N,)."""
        recycled = self.recycled(nodes, prediction.outlet, prediction.speed)
        return values - self.kappa(prediction.state) + recycled

    def inverse_transformation(self, nodes: Nodes, target, prediction: Prediction) -> np.ndarray:
        """u(x, t) (inverse backstepping transformation); target w (N,), prediction pi; (N,)."""
        recycled = self.recycled(nodes, prediction.outlet, prediction.speed)
        return target + self.kappa(prediction.state) - recycled


# ---- Predictor feedback design methodology ----


class Characteristics:
    """The characteristic curves of a run, from how far the belt has moved.

    xi(t) [m], the integral of lambda from 0 (psi), turns each question into one about xi:
    zeta(s; x, t) = x + xi(t) - xi(s) (xi_zeta). Cubic between the instants of the run.
    """

    def __init__(self, times, distances, speeds) -> None:
        """times [s], distances xi [m], speeds lambda [m/s]: (K,); a time may stand twice."""
        keep = np.append(True, np.diff(times) > 0.0)
        times, distances, speeds = times[keep], distances[keep], speeds[keep]
        self.distance = CubicHermiteSpline(times, distances, speeds, extrapolate=False)
        self.time = CubicHermiteSpline(distances, times, 1.0 / speeds, extrapolate=False)

    def curve(self, instant, position, time):
        """zeta(s; x, t) [m] (cline); NaN outside the run."""
        return position + self.distance(time) - self.distance(instant)

    def entered(self, position, time, belt_length: float):
        """phi(x, t) [s]: when the material now at x was fed, zeta(phi; x, t) = D (dp)."""
        return self.time(self.distance(time) + position - belt_length)

    def leaves(self, position, time):
        """sigma(x, t) [s]: when the material now at x leaves, zeta(sigma; x, t) = 0."""
        return self.time(self.distance(time) + position)


def delayed_outlet(system: BoundaryControl, curves: Characteristics, times, controls, outlets, t):
    """u(0, t) by (apu0): U at phi(0, t), and the recycle gathered since.

    times, controls U, outlets u(0, .): (K,) of a run whose control has no jump after phi; t [s].
    """
    start = float(curves.entered(0.0, t, system.belt_length))
    between = times[(times > start) & (times < t)]
    instants = np.concatenate([[start], between, [t]])
    gathered = system.g(curves.curve(instants, 0.0, t)) * np.interp(instants, times, outlets)
    return np.interp(start, times, controls) + np.trapezoid(gathered, instants)
