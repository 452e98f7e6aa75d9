# SPDX-License-Identifier: MIT
"""The paper's own simulation (Section 5): upwind plant, first-order march, one law a time step.

Kept to reproduce the paper's curves and to show what the misprint in (C0) does. Everything else
uses predictor.py.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from reference.level_history import LevelHistory
from reference.line import Law, Line
from reference.nominal_law import NominalLaw, nominal_law
from reference.upwind import UpwindPlant


def rework_by_mf1(line: Line, integral: float) -> float:
    """The rework term of (MF1) from the integral of A*y*p2*(1+p3(y))/(K(D,y)*(1+p3(0)))."""
    return integral


def rework_as_printed_in_c0(line: Line, integral: float) -> float:
    """The rework term of (C0) as printed, with its stray factor P."""
    return line.processing_time * integral


def inlet_flux(
    line: Line,
    law: NominalLaw,
    densities: np.ndarray,
    history: LevelHistory,
    rework_term: Callable[[Line, float], float] = rework_by_mf1,
) -> float:
    """U [parts/s] by a march on equally spaced nodes, every integral a left sum.

    densities [parts/m]: shape (N+1,), of which the last does not enter.
    """
    count = len(densities) - 1
    dx = line.belt_length / count
    positions = np.arange(count + 1) * dx
    loss = line.loss(positions)
    outlet_density, slowness = np.zeros(count), np.zeros(count)
    history, level = history.recent(), history.levels[-1]
    arrival_time, congestion = history.times[-1], history.congestion()
    for node in range(count + 1):
        # K(x, x)/K(x, y) at y = 0 ... x; loss[node - j] is C(x - z) at z = j*dx
        strips = loss[node:0:-1] * slowness[:node] * dx
        exponent = np.concatenate([[0.0], np.cumsum(strips)])
        ratios = np.exp(exponent - exponent[-1])
        reach = positions[node] - positions[:node]
        picked_up = line.rework(reach, outlet_density[:node]) * slowness[:node] * ratios[:-1]
        if node == count:
            break
        slowness[node] = line.slowness(congestion)
        outlet_density[node] = ratios[0] * densities[node] + dx * picked_up.sum()
        drift = line.connectivity * outlet_density[node] - line.service(level) * slowness[node]
        level += dx * drift
        arrival_time += dx * slowness[node]
        congestion = history.congestion_if(arrival_time, level)
        history.append(arrival_time, level)
    demanded = law.flux(level) * line.slowness(congestion)
    integral = dx * float(picked_up.sum()) / (ratios[0] * slowness[0])
    return float(demanded / (ratios[0] * slowness[0]) - rework_term(line, integral))


def simulate(
    line: Line,
    law: Law,
    duration: float = 10.0,
    node_count: int = 80,
    dt: float = 0.0025,
    rework_term: Callable[[Line, float], float] = rework_by_mf1,
) -> dict[str, np.ndarray]:
    """The paper's closed loop from the empty line: time [s], buffer_level [parts] and inlet_flux
    [parts/s] at each of round(duration/dt) + 1 instants. First order in dt and the spacing."""
    plant = UpwindPlant(line, node_count, dt)
    active = nominal_law(line, law)
    history = LevelHistory.constant(line.speed_window, 0.0, plant.level)
    rows = []
    for _ in range(round(duration / dt) + 1):
        flux = inlet_flux(line, active, plant.densities, history, rework_term)
        flux = max(flux, 0.0)
        rows.append((plant.time, plant.level, flux))
        plant.substep(flux)
        history.append(plant.time, plant.level)
    return dict(zip(("time", "buffer_level", "inlet_flux"), np.array(rows).T, strict=True))
