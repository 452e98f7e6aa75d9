# SPDX-License-Identifier: MIT
"""The paper's own scheme (Section 5) as a plant: upwind in space, forward Euler in time.

First order: it smears every front. Nodes x_i = i*dx, i = 0 ... N. One substep of length dt, all
right sides at its start:

    speed = 1/(P*(1 + R/congestion_scale)),   rho_N = U/speed
    rho_i += dt*(speed*(rho_{i+1} - rho_i)/dx + A*(D - x_i)*rho_0 - C(x_i)*rho_i),  i < N
    Q     += dt*(alpha*speed*rho_0 - min(Q/service_time, mu)), spilling above level_capacity
    R      = the last speed_window of Q by the trapezoid rule, linear between the substeps
"""

from __future__ import annotations

import numpy as np

from reference.line import Line, profile


class UpwindPlant:
    """time [s], level [parts], densities [parts/m] of shape (N+1,), congestion [parts s],
    parts_spilled [parts]; levels: Q at every substep, the present one last."""

    def __init__(
        self, line: Line, node_count: int, dt: float, initial_level=0.0, initial_density=0.0
    ) -> None:
        """At rest at time 0, the level held for a whole window before; dt [s] of a substep."""
        self.line = line
        self.dt = dt
        self.time = 0.0
        self.dx = line.belt_length / node_count
        self.positions = np.arange(node_count + 1) * self.dx
        self.densities = profile(initial_density, line.belt_length, self.positions)
        self.loss = line.loss(self.positions[:-1])
        self.level = float(initial_level)
        self.parts_spilled = 0.0
        self.intervals = int(np.floor(line.speed_window / dt + 1e-9))
        self.levels = [self.level] * (self.intervals + 2)
        self.congestion = self.window_integral()

    @property
    def outlet_flux(self) -> float:
        """phi = omega(R)*rho(0) [parts/s] (Mp1)."""
        return float(self.line.transport_speed(self.congestion) * self.densities[0])

    def window_integral(self) -> float:
        """R [parts s]: n whole intervals and the remaining fraction of one older interval."""
        count, dt = self.intervals, self.dt
        fraction = self.line.speed_window / dt - count
        whole = dt * float(np.trapezoid(self.levels[-count - 1 :]))
        newer, older = self.levels[-count - 1], self.levels[-count - 2]
        return whole + fraction * dt * (newer + 0.5 * fraction * (older - newer))

    def substep(self, inlet_flux: float) -> None:
        """Go on by dt with the inlet flux [parts/s]."""
        line, dt = self.line, self.dt
        speed = float(line.transport_speed(self.congestion))
        self.densities[-1] = inlet_flux / speed
        before = self.densities.copy()
        here, leaving = before[:-1], float(before[0])
        slope = (before[1:] - here) / self.dx
        rework = line.rework(self.positions[:-1], leaving)
        self.densities[:-1] = here + dt * (speed * slope + rework - self.loss * here)
        drift = line.connectivity * speed * leaving - line.service(self.level)
        level = self.level + dt * drift
        self.level = min(level, line.level_capacity)
        self.parts_spilled += level - self.level
        self.time += dt
        self.levels.append(self.level)
        self.congestion = self.window_integral()


def drive(
    line: Line,
    inlet_flux,
    period: float,
    substeps: int = 1,
    node_count: int = 80,
    initial_level: float = 0.0,
    initial_density=0.0,
) -> dict[str, np.ndarray]:
    """Feed a given inlet flux [parts/s], shape (K,), one value a period [s].

    Returns time, buffer_level, outlet_flux, congestion, each of shape (K+1,): entry k at the start
    of period k, the last one at the end; outlet_flux is omega(R)*rho_0 at that instant's R.
    """
    plant = UpwindPlant(line, node_count, period / substeps, initial_level, initial_density)
    rows = [(0.0, plant.level, plant.outlet_flux, plant.congestion)]
    for count, flux in enumerate(inlet_flux, start=1):
        for _ in range(substeps):
            plant.substep(float(flux))
        rows.append((count * period, plant.level, plant.outlet_flux, plant.congestion))
    names = ("time", "buffer_level", "outlet_flux", "congestion")
    return dict(zip(names, np.array(rows).T, strict=True))
