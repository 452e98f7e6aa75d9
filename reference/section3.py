# SPDX-License-Identifier: MIT
"""Section 3: flux control, nonlinear recycle and friction. In the order of the paper.

    X'(t) = f(X(t), q(t)),  q(t) = lambda(R(t)) u(0, t)              (M1), (M2)
    u_t = lambda(R(t)) u_x + g(x, u(0, t)) + c(x) u                  (M3)
    U(t) = lambda(R(t)) u(D, t)                                      (M4)

gamma, zeta, phi and the conventions of arrays are those of Section 2. What the norm equivalence
rests on is at the end, with its two misprints.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference.integral_equations import Nodes, Prediction


@dataclass(frozen=True)
class FluxControl:
    """A system of Section 3.

    belt_length D [m], speed_window tau [s]; f(X, q) [X per s]: (n, ...), (...) -> (n, ...);
    g(x, v) [u per s], Lipschitz in v and 0 at v = 0 (Assumption 3); c(x) [1/s]; speed(R), the
    paper's lambda [m/s]: (n, ...) -> (...); kappa(X), a flux: (n, ...) -> (...).
    Raises ValueError for a length or window not positive.
    """

    belt_length: float
    speed_window: float
    f: Callable
    g: Callable
    c: Callable
    speed: Callable
    kappa: Callable

    def __post_init__(self) -> None:
        if not (self.belt_length > 0.0 and self.speed_window > 0.0):
            raise ValueError("belt_length and speed_window must be positive")

    # what the plant asks of either section

    def ode_input(self, speed, outlet):
        """q(t) = lambda u(0, t) (M2)."""
        return speed * outlet

    def source(self, position, outlet):
        """g(x, u(0, t)) of (M3), any shape."""
        return self.g(position, outlet)

    def friction(self, position):
        """c(x) [1/s] of (M3), any shape."""
        return np.broadcast_to(self.c(position), np.shape(position))

    def inlet_value(self, control, speed):
        """u(D, t) = U(t)/lambda (M4)."""
        return control / speed

    # the predictor, (MF1) to (MF7)

    def control(self, nodes: Nodes, prediction: Prediction) -> float:
        """U(t) (MF1); the last node is at D."""
        outlet, speed = prediction.outlet, prediction.speed
        kernel = np.exp(self.exponents(nodes, speed, last_only=True))  # K(D, y, t)
        reach = self.belt_length - nodes.positions
        demanded = self.kappa(prediction.state[:, -1]) / (speed[-1] * kernel[-1])
        recycled = nodes.weights[-1] @ (self.g(reach, outlet) / (kernel * speed))
        return float(speed[0] * (demanded - recycled))

    def predicted_state(self, nodes: Nodes, present, state, outlet, speed) -> np.ndarray:
        """Right side of (MF3): X(t) (n,) and the layers at the nodes; (n, N)."""
        return present[:, None] + nodes.integral(self.f(state, speed * outlet) / speed)

    def predicted_outlet(self, nodes: Nodes, values, outlet, speed) -> np.ndarray:
        """Right side of (MF4); values u (N,); (N,)."""
        exponents = self.exponents(nodes, speed)
        survival = np.exp(np.diagonal(exponents))
        return survival * values + self.recycled(nodes, outlet, speed, exponents)

    def recycled(self, nodes: Nodes, outlet, speed, exponents) -> np.ndarray:
        """The integral of (MF4) over y in [0, x], at each x; (N,)."""
        ratios = np.exp(np.diagonal(exponents)[:, None] - exponents)  # K(x, x)/K(x, y) (p2t1)
        sources = self.g(nodes.reach, outlet[None, :]) / speed  # J (p2t2)
        return np.einsum("xy,xy,xy->x", nodes.weights, ratios, sources)

    def arrival_time(self, nodes: Nodes, now: float, speed) -> np.ndarray:
        """sigma [s] (MF6); (N,)."""
        return now + nodes.integral(1.0 / speed)

    def exponents(self, nodes: Nodes, speed, last_only: bool = False) -> np.ndarray:
        """log K(x1, x2, t) (MF7): row x1, column x2; (N, N), or the row x1 = D alone (N,).

        Above the diagonal, where K is not defined, c(0) stands in.
        """
        friction = nodes.table(self.c)
        return nodes.integral((friction[-1] if last_only else friction) / speed)

    def kernel(self, nodes: Nodes, speed) -> np.ndarray:
        """K(x1, x2, t) (MF7): row x1, column x2 (N, N); NaN outside its domain x2 <= x1."""
        lower = np.tri(len(nodes), dtype=bool)
        return np.where(lower, np.exp(self.exponents(nodes, speed)), np.nan)

    # the transformations

    def outlet_demanded(self, state, speed, target=0.0):
        """p2 where w is `target`: (w + kappa(p1))/lambda(p3) (npi2)."""
        return (target + self.kappa(state)) / speed

    def transformation(self, nodes: Nodes, values, prediction: Prediction) -> np.ndarray:
        """w(x, t) (nonlinear backstepping); values u (N,); (N,)."""
        outlet, speed = prediction.outlet, prediction.speed
        exponents = self.exponents(nodes, speed)
        survival = np.exp(np.diagonal(exponents))
        recycled = self.recycled(nodes, outlet, speed, exponents)
        return speed * survival * values - self.kappa(prediction.state) + speed * recycled

    def inverse_kernel(self, nodes: Nodes, speed) -> np.ndarray:
        """L(x1, x2, t) (kernel L), as K; speed is lambda(pi3)."""
        lower = np.tri(len(nodes), dtype=bool)
        return np.where(lower, np.exp(-self.exponents(nodes, speed)), np.nan)

    def inverse_transformation(self, nodes: Nodes, target, prediction: Prediction) -> np.ndarray:
        """u(x, t) (non inverse backstepping); target w (N,), prediction pi; (N,)."""
        outlet, speed = prediction.outlet, prediction.speed
        kernel = np.nan_to_num(self.inverse_kernel(nodes, speed))
        sources = kernel * self.g(nodes.reach, outlet[None, :]) / speed
        demanded = (target + self.kappa(prediction.state)) / speed
        return np.diagonal(kernel) * demanded - np.einsum("xy,xy->x", nodes.weights, sources)
