# SPDX-License-Identifier: MIT
"""The layered predictor (MF1)-(MF7), of which (C1)-(C3) are the case of linear rework.

At each place x the march answers, for the material now at x: when will it reach the outlet
(sigma), what will the buffer hold then (p1), which density will leave the belt (p2), and how
congested will the line be (p3).

Nodes are any ascending positions from 0; two nodes at one position are the two sides of a jump,
outlet side first. All integrals are by the trapezoid rule, hence of second order, and a jump
costs no accuracy because no strip reaches across it.

(C0) is not used: it prints a stray factor P in the rework integral. (MF1) has none.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.level_history import LevelHistory
from reference.line import Line
from reference.nominal_law import NominalLaw

# The unknowns of a node stand on both sides of its equations. Each pass of the fixed point gains
# at least two decimals at a hundred nodes to the belt; one that changes no bit is the last.
PASSES = 6


@dataclass(frozen=True)
class Prediction:
    """The march at its nodes; arrays of one shape, ordered outlet to inlet.

    positions x [m], predicted_level p1 [parts], outlet_density p2 [parts/m], congestion p3
    [parts s], slowness 1/lambda(p3) [s/m], arrival_time sigma [s], survival K(x, x) [-],
    rework I(x) [parts/m]: the second term of (MF4).
    """

    positions: np.ndarray
    predicted_level: np.ndarray
    outlet_density: np.ndarray
    congestion: np.ndarray
    slowness: np.ndarray
    arrival_time: np.ndarray
    survival: np.ndarray
    rework: np.ndarray


class March:
    """One march along the belt; `prediction` is filled node by node."""

    def __init__(self, line: Line, positions, densities, history: LevelHistory) -> None:
        """positions [m] and densities [parts/m]: one shape; history ends at the present time."""
        self.line = line
        self.densities = densities
        self.history = history.recent()
        self.gaps = np.diff(positions)
        self.weights = 0.5 * (np.append(0.0, self.gaps) + np.append(self.gaps, 0.0))
        self.reach = np.subtract.outer(positions, positions)
        self.loss = line.loss(self.reach)
        blank = [np.zeros(len(positions)) for _ in range(7)]
        self.prediction = Prediction(np.asarray(positions, dtype=float), *blank)
        self.start()

    def start(self) -> None:
        """At x = 0 the prediction is the present."""
        result = self.prediction
        result.predicted_level[0] = self.history.levels[-1]
        result.outlet_density[0] = self.densities[0]
        result.congestion[0] = self.history.congestion()
        result.slowness[0] = self.line.slowness(result.congestion[0])
        result.arrival_time[0] = self.history.times[-1]
        result.survival[0] = 1.0

    def kernel_ratios(self, node: int) -> np.ndarray:
        """K(x, x)/K(x, y) of (MF7) for x at the node and y at nodes 0 ... node; shape (node+1,).

        K(x, 0) = 1, so the first entry is the survival K(x, x).
        """
        rate = self.loss[node, : node + 1] * self.prediction.slowness[: node + 1]
        exponent = np.zeros(node + 1)
        np.cumsum(0.5 * self.gaps[:node] * (rate[1:] + rate[:-1]), out=exponent[1:])
        return np.exp(exponent - exponent[-1])

    def rework_before(self, node: int, ratios: np.ndarray) -> float:
        """The integral of (MF4) at the node without the node's own half strip [parts/m]."""
        result = self.prediction
        picked_up = self.line.rework(self.reach[node, :node], result.outlet_density[:node])
        picked_up *= result.slowness[:node]
        picked_up *= ratios[:node]
        return float(picked_up @ self.weights[:node])

    def arrive(self, node: int, level: float) -> None:
        """sigma (MF6), p3 (MF5) and 1/lambda(p3) at the node, p1 there being `level`."""
        result = self.prediction
        half_gap = 0.5 * float(self.gaps[node - 1])
        before = float(result.slowness[node - 1])
        start = float(result.arrival_time[node - 1])
        slowness = before
        for _ in range(PASSES):
            arrival_time = start + half_gap * (before + slowness)
            congestion = self.history.congestion_if(arrival_time, level)
            last, slowness = slowness, self.line.slowness(congestion)
            if slowness == last:
                break
        result.arrival_time[node] = arrival_time
        result.congestion[node] = congestion
        result.slowness[node] = slowness

    def step(self, node: int, law: NominalLaw | None = None) -> None:
        """March from the node before to this one.

        With a law, the node is the one about to be fed: its p2 is what the law demands,
        kappa(p1)/lambda(p3), and its density is left open. The node's p3 is found with an Euler
        guess of p1, wrong by O(dx^2), which moves p3 by O(dx^3) only; one correction follows.
        """
        result, line = self.prediction, self.line
        gap = float(self.gaps[node - 1])
        before = float(result.predicted_level[node - 1])
        slope = line.connectivity * float(result.outlet_density[node - 1])
        slope -= line.service(before) * float(result.slowness[node - 1])
        level = before + gap * slope
        self.arrive(node, level)
        ratios = self.kernel_ratios(node)
        slowness, survival = float(result.slowness[node]), float(ratios[0])
        carried = self.rework_before(node, ratios)
        density = survival * float(self.densities[node]) + carried if law is None else 0.0
        outlet_density, own = density, 0.0
        for _ in range(PASSES):
            last = level, outlet_density
            if law is None:
                own = 0.5 * gap * slowness * line.rework(0.0, outlet_density)
                outlet_density = density + own
            else:
                outlet_density = law.flux(level) * slowness
                own = 0.5 * gap * slowness * line.rework(0.0, outlet_density)
            drift = line.connectivity * outlet_density - line.service(level) * slowness
            level = before + 0.5 * gap * (slope + drift)
            if (level, outlet_density) == last:
                break
        self.arrive(node, level)
        result.predicted_level[node] = level
        result.outlet_density[node] = outlet_density
        result.survival[node] = survival
        result.rework[node] = carried + own
        self.history.append(float(result.arrival_time[node]), level)


def predict(line: Line, positions, densities, history: LevelHistory) -> Prediction:
    """p1, p2, p3, sigma, K(x, x) and I(x) for a belt that is known everywhere (MF3)-(MF7).

    positions [m], densities [parts/m]: shape (n,), positions ascending from 0; history ends now.
    """
    march = March(line, positions, densities, history)
    for node in range(1, len(positions)):
        march.step(node)
    return march.prediction


def inlet_flux(line: Line, law: NominalLaw, positions, densities, history: LevelHistory):
    """The inlet flux U [parts/s] by (MF1), and the march it came from.

    positions and densities as in predict: the material fed so far, the last node at D or short
    of it. The march adds one node at D, the material about to be fed, whose outlet density is
    kappa(p1(D))/lambda(p3(D)), and (MF1) is (MF4) at that node solved for its density.
    Returns (U, prediction); U is not limited and may be negative.
    """
    positions = np.append(positions, line.belt_length)
    march = March(line, positions, np.append(densities, np.nan), history)
    last = len(positions) - 1
    for node in range(1, last):
        march.step(node)
    march.step(last, law)
    result = march.prediction
    demanded = result.outlet_density[last] - result.rework[last]
    return float(demanded / (result.survival[last] * result.slowness[0])), result


def kernel(line: Line, prediction: Prediction) -> np.ndarray:
    """K(x, y) of (MF7) at the nodes, shape (n, n), row x, column y; NaN above the diagonal."""
    positions, slowness = prediction.positions, prediction.slowness
    rate = line.loss(np.subtract.outer(positions, positions)) * slowness
    strips = 0.5 * np.diff(positions) * (rate[:, 1:] + rate[:, :-1])
    exponent = np.concatenate([np.zeros((len(positions), 1)), np.cumsum(strips, axis=1)], axis=1)
    lower = np.tri(len(positions), dtype=bool)
    return np.where(lower, np.exp(-exponent), np.nan)
