# SPDX-License-Identifier: MIT
"""Proposition 2: when the inlet flux of the conveyor stays positive, in its right dimensions.

By (MF1), U(t) > 0 says u(Q*, p1(D)) > lambda(p3(D))*I(D): what the law wants to arrive exceeds
what the rework of the material ahead will bring, I(D) being the integral of (MF4). Four facts
bound both sides for all t >= 0. K(D, D)/K(D, y) <= 1. The level stays where it is: from
sigma(D, 0) on it goes monotonically from p1(D, 0) to Q*, so u(Q*, p1(D, t)) >= the lesser of
Q*/(alpha*service_time) and u(Q*, p1(D, 0)). 1/lambda lies between P and P*s,
s = 1 + tau*Qmax/congestion_scale. And p2 <= M. Hence

    u*P > A*M*P*s*D^2/2,   that is   M/u < 2/(A*D^2*s)                      (Abound), derived

Left and right are in s/m. The paper prints 2/(A*D*P^2*s), which is in m^2/s: written in other
units the same line passes or fails.

Sharper, from the same facts: p2 is carried by the material and equals u(Q*, p1)/lambda(p3) for
all that the law has fed, so no exponential bounds it; the levels to come are known, so s and the
speeds have known bounds; loss on the way counts; and what is on the belt now is known place by
place. See `sharper`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from reference.integral_equations import Nodes, compatibility, predict
from reference.line import Law, Line
from reference.nominal_law import nominal_law
from reference.record import Record
from reference.section4 import conveyor, nominal_flux

NODE_COUNT = 100


@dataclass(frozen=True)
class State:
    """The line at one instant: record of the level, belt as positions [m] and densities [parts/m]
    from outlet to inlet."""

    record: Record
    positions: np.ndarray
    densities: np.ndarray

    @classmethod
    def held(cls, line: Line, level: float, density=0.0, node_count: int = NODE_COUNT) -> State:
        """A level [parts] held for a whole window; density a number or a function of position."""
        positions = np.linspace(0.0, line.belt_length, node_count + 1)
        values = density(positions) if callable(density) else density
        densities = np.broadcast_to(np.asarray(values, dtype=float), positions.shape)
        return cls(Record.of(line.speed_window, np.array([level])), positions, densities)


@dataclass(frozen=True)
class Promise:
    """A sufficient condition: U > 0 for all times to come when `holds`.

    flux_min: least nominal flux to come [parts/s]; density_max M [parts/m]: most that p2 can be;
    left < right is the inequality, margin = right/left (inf without rework) is above 1 when it
    holds; applies: what the proposition presupposes of the state.
    """

    flux_min: float
    density_max: float
    left: float
    right: float
    applies: bool

    @property
    def margin(self) -> float:
        return float(self.right / self.left) if self.left > 0.0 else np.inf

    @property
    def holds(self) -> bool:
        return self.applies and self.left < self.right


def crowding_max(line: Line) -> float:
    """1 + tau*Qmax/congestion_scale [-]."""
    return 1.0 + line.speed_window * line.level_capacity / line.congestion_scale


def predicted(line: Line, law: Law, state: State):
    """The march over the belt as it is."""
    nodes = Nodes(state.positions)
    return predict(conveyor(line, law), nodes, state.densities, state.record)


def presupposed(line: Line, state: State, last_level: float) -> bool:
    """0 <= Q(0) < Qmax, 0 <= p1(D, 0) <= Qmax, no negative density, no loss rate below 0."""
    level = float(state.record.state[0])
    ends = 0.0 <= level < line.level_capacity and 0.0 <= last_level <= line.level_capacity
    return bool(ends and np.min(state.densities) >= 0.0 and min(line.loss_rate) >= 0.0)


def proposition_2(line: Line, law: Law, state: State) -> Promise:
    """(Abound), (Mchar) with the right side as derived above; left M/u and right in s/m."""
    active = nominal_law(line, law)
    last_level = float(predicted(line, law, state).state[0, -1])
    crowded, length = crowding_max(line), line.belt_length
    slowness = line.processing_time * crowded
    fluxes = nominal_flux(active, np.array([state.record.state[0], last_level]))
    flux_min = float(min(active.hold_flux, *fluxes))
    density_start = float(max(np.max(state.densities), slowness * crowded * law.nominal_flux_max))
    growth = 2.0 * line.rework_rate * length**2 * slowness
    density_max = density_start * float(np.exp(growth))
    scale = line.rework_rate * length**2 * crowded
    right = 2.0 / scale if scale > 0.0 else np.inf
    left = density_max / flux_min if flux_min > 0.0 else np.inf
    applies = presupposed(line, state, last_level)
    return Promise(flux_min, density_max, left, right, applies)


def right_as_printed(line: Line) -> float:
    """The right side of (Abound) as printed, in m^2/s; crowding as in the paper's units."""
    scale = line.rework_rate * line.belt_length * line.processing_time**2 * crowding_max(line)
    return 2.0 / scale


def sharper(line: Line, law: Law, state: State) -> Promise:
    """A sharper sufficient bound; left and right are fluxes [parts/s]:

        ratio * max over xi of J(xi)  <  u,    u = min(Q*/(alpha*service_time), u(Q*, p1(D, 0)))
        J(xi) = integral over [0, D] of A*y*E(D - y)*p2_xi(y)
        p2_xi(y) = p2(y + xi, 0) where that material is on the belt now, else M
        M = P*s_high*max(Q*/(alpha*service_time), u(Q*, p1(D, 0)))
        E(r) = exp(-P*s_low * integral of C over [0, r]) >= K(D, D)/K(D, D - r)
        ratio = 1 + (tau/congestion_scale)*fall/s_low >= lambda(p3(D))/lambda(p3(y))

    s_low and s_high: 1 + tau*Q/congestion_scale at the lowest and highest level in the window, on
    the belt (p1(x, 0)) and on the way to Q*; fall: by how much a later one of these levels lies
    below an earlier one, 0 while the level only rises. xi is how far the belt has moved.
    """
    active = nominal_law(line, law)
    result = predicted(line, law, state)
    record, last_level = state.record, float(result.state[0, -1])
    first = np.searchsorted(record.times, record.time - record.speed_window, side="right") - 1
    recent = record.states[0, max(first, 0) :]
    levels = np.concatenate([recent, result.state[0], [law.level_setpoint]])
    crowded = 1.0 + line.speed_window / line.congestion_scale * np.array(
        [levels.min(), levels.max()]
    )
    fall = float(np.max(np.maximum.accumulate(levels) - levels))
    ratio = 1.0 + line.speed_window / line.congestion_scale * fall / crowded[0]
    fluxes = active.hold_flux, float(nominal_flux(active, last_level))
    density_fed = line.processing_time * crowded[1] * max(fluxes)
    carried = rework_ahead(line, state.positions, result.outlet, density_fed, crowded[0])
    density_max = float(max(np.max(result.outlet), density_fed))
    applies = presupposed(line, state, last_level)
    return Promise(min(fluxes), density_max, float(ratio * carried), min(fluxes), applies)


def rework_ahead(line: Line, positions, outlet, density_fed: float, crowding: float) -> float:
    """max over xi of J(xi) [parts/s] of `sharper`, on the nodes; p2(x, 0) is `outlet` (N,)."""
    places = np.linspace(0.0, line.belt_length, 2 * len(positions))
    loss = line.loss(places)
    strips = 0.5 * np.diff(places) * (loss[1:] + loss[:-1])
    lost = np.append(0.0, np.cumsum(strips))[::-1]  # integral of C over [0, D - y]
    weight = line.rework_rate * places * np.exp(-line.processing_time * crowding * lost)
    moved = places[:, None] + places[None, :]
    known = np.interp(moved, positions, outlet)
    carried = np.where(moved <= line.belt_length, known, density_fed)
    return float(np.max(np.trapezoid(weight * carried, places, axis=1)))


def starts_compatibly(line: Line, law: Law, state: State) -> float:
    """rho(D, 0) minus what (nu0) asks for [parts/m]: 0 when no front enters the belt.

    The inlet stands twice among the nodes, as the two sides of the front: it has no width.
    """
    positions = np.append(state.positions, state.positions[-1])
    densities = np.append(state.densities, state.densities[-1])
    return compatibility(conveyor(line, law), positions, densities, state.record)
