# SPDX-License-Identifier: MIT
"""The line (M1)-(M4) solved along its characteristics: nodes that ride with the material.

Along x(t) with x' = -transport_speed, density changes by rework and loss alone. All nodes share
one speed, so a step moves them all by one distance: nothing diffuses, and a jump, kept as two
nodes at one position, stays a jump. Every rule is the trapezoid's: second order.
"""

from __future__ import annotations

import numpy as np

from reference.level_history import LevelHistory
from reference.line import Line, profile

PASSES = 6  # of the implicit step's fixed point; each gains two decimals or more
NEAR = 1e-9  # share of the belt within which a jump counts as having reached the outlet


class Plant:
    """Belt, buffer and level history at one instant.

    time [s], level [parts], history, positions [m] and densities [parts/m] of the nodes (the
    first always at 0), parts_spilled [parts].
    """

    def __init__(self, line: Line, spacing: float, level: float = 0.0, density=0.0) -> None:
        """At rest at time 0: a level held for a whole window, a density profile, node spacing [m].

        density: a number, or values equally spaced from outlet to inlet, linear between.
        """
        self.line = line
        self.time = 0.0
        self.level = float(level)
        self.history = LevelHistory.constant(line.speed_window, 0.0, self.level)
        pieces = max(np.size(density) - 1, 1)
        count = pieces * int(np.ceil(line.belt_length / (pieces * spacing) - NEAR))
        self.positions = np.linspace(0.0, line.belt_length, count + 1)
        self.densities = profile(density, line.belt_length, self.positions)
        self.parts_spilled = 0.0

    @property
    def congestion(self) -> float:
        """R(t) [parts s]."""
        return self.history.congestion()

    @property
    def transport_speed(self) -> float:
        """omega(R(t)) [m/s]."""
        return float(self.line.transport_speed(self.congestion))

    @property
    def outlet_flux(self) -> float:
        """phi(t) = omega(R(t))*rho(0, t) [parts/s] (Mp1)."""
        return self.transport_speed * float(self.densities[0])

    @property
    def belt_content(self) -> float:
        """Parts on the belt, by the trapezoid rule over the nodes."""
        return float(np.trapezoid(self.densities, self.positions))

    def feed(self, inlet_flux: float) -> None:
        """Give the belt a node at x = D carrying rho(D, t) = U/omega(R(t)) (Mpd)."""
        self.positions = np.append(self.positions, self.line.belt_length)
        self.densities = np.append(self.densities, inlet_flux / self.transport_speed)

    def advance(self, target: float) -> None:
        """Go on to the time given, stopping on the way wherever a jump reaches the outlet."""
        while self.time < target:
            distance = (target - self.time) * self.transport_speed
            jump = self.next_jump()
            for _ in range(3):  # the speed hardly changes within a step
                distance *= (target - self.time) / self.try_step(distance)[0]
            if distance > jump - NEAR * self.line.belt_length:
                distance = jump
            self.step(distance)
            if abs(target - self.time) < NEAR * self.line.belt_length / self.transport_speed:
                self.time = self.history.times[-1] = target

    def next_jump(self) -> float:
        """Position [m] of the jump nearest the outlet; infinite when there is none."""
        jumps = self.positions[1:][np.diff(self.positions) == 0.0]
        return float(jumps[0]) if jumps.size else np.inf

    def at_position(self, distance: float) -> float:
        """rho [parts/m] between the nodes; on a jump, its outlet side."""
        last = int(np.searchsorted(self.positions, distance))
        last = min(max(last, 1), len(self.positions) - 1)
        span = slice(last - 1, last + 1)
        return float(np.interp(distance, self.positions[span], self.densities[span]))

    def aged(self, position, density, distance, duration, leaving_before, leaving_after):
        """Density [parts/m] of material that was at `position` and has moved by `distance`.

        rho' = g(x, rho(0)) - C(x)*rho along the characteristic (M3), the loss as an integrating
        factor, the rework by the trapezoid rule. Any shape.
        """
        line = self.line
        mean_loss = 0.5 * (line.loss(position) + line.loss(position - distance))
        kept = density + 0.5 * duration * line.rework(position, leaving_before)
        picked_up = 0.5 * duration * line.rework(position - distance, leaving_after)
        return np.exp(-mean_loss * duration) * kept + picked_up

    def try_step(self, distance: float) -> tuple[float, float, float]:
        """(duration [s], level [parts], leaving density [parts/m]) of a step of this distance."""
        line, before = self.line, float(self.densities[0])
        slow = slow_after = line.slowness(self.congestion)
        start, level, leaving = self.at_position(distance), self.level, before
        drift = line.connectivity * before / slow - line.service(level)
        for _ in range(PASSES):
            duration = 0.5 * distance * (slow + slow_after)
            leaving = float(self.aged(distance, start, distance, duration, before, leaving))
            drift_after = line.connectivity * leaving / slow_after - line.service(level)
            level = self.level + 0.5 * duration * (drift + drift_after)
            slow_after = line.slowness(self.history.congestion_if(self.time + duration, level))
        return duration, level, leaving

    def step(self, distance: float) -> None:
        """Move the belt by a distance [m] that no jump lies within; a jump may lie at its end."""
        duration, level, leaving = self.try_step(distance)
        before = float(self.densities[0])
        stays = np.searchsorted(self.positions, distance, side="right")
        positions, densities = self.positions[stays:], self.densities[stays:]
        aged = self.aged(positions, densities, distance, duration, before, leaving)
        at_outlet = leaving
        if stays >= 2 and self.positions[stays - 2] == self.positions[stays - 1] == distance:
            start = self.densities[stays - 1]  # the inlet side of the jump leaves from here on
            at_outlet = float(self.aged(distance, start, distance, duration, before, leaving))
        self.positions = np.append(0.0, positions - distance)
        self.densities = np.append(at_outlet, aged)
        self.time += duration
        self.level = min(level, self.line.level_capacity)
        self.parts_spilled += level - self.level
        self.history.append(self.time, self.level)
