# SPDX-License-Identifier: MIT
"""The line at rest at a level: the stationary belt, and the constant flux that holds it.

This constant flux is the "open loop" of Section 5.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import quad

from reference.line import Line


def outlet_density(line: Line, level_setpoint: float) -> float:
    """rho(0) [parts/m] that holds the level [parts]: service(Q*)/(alpha*lambda)."""
    outlet_flux = line.service(level_setpoint) / line.connectivity
    return outlet_flux * line.slowness(level_setpoint * line.speed_window)


def loss_exponent(line: Line, level_setpoint: float, position: float) -> float:
    """The integral of C/lambda from the outlet to the position [-], exact for the profile."""
    knots = np.linspace(0.0, line.belt_length, max(len(line.loss_rate), 2))
    knots = np.append(knots[knots < position], position)
    area = np.trapezoid(line.loss(knots), knots)
    return float(area * line.slowness(level_setpoint * line.speed_window))


def density(line: Line, level_setpoint: float, position: float) -> float:
    """Stationary rho(x) [parts/m]: lambda*rho_x = C(x)*rho - g(x, rho(0)) solved from the outlet.

    rho(x) = E(x)*(rho(0) - integral over [0, x] of g(y, rho(0))/(lambda*E(y))),
    E(x) = exp(integral of C/lambda over [0, x]).
    """
    slowness = line.slowness(level_setpoint * line.speed_window)
    leaving = outlet_density(line, level_setpoint)

    def picked_up(place: float) -> float:
        grown = np.exp(loss_exponent(line, level_setpoint, place))
        return line.rework(place, leaving) * slowness / grown

    kinks = np.linspace(0.0, line.belt_length, max(len(line.loss_rate), 2))[1:-1]
    kinks = kinks[kinks < position]
    rework = quad(picked_up, 0.0, position, points=kinks if kinks.size else None, epsabs=1e-13)[0]
    return float(np.exp(loss_exponent(line, level_setpoint, position)) * (leaving - rework))


def inlet_flux(line: Line, level_setpoint: float) -> float:
    """The constant U [parts/s] whose equilibrium is the set-point: 0.974 in the paper's case."""
    speed = line.transport_speed(level_setpoint * line.speed_window)
    return float(speed * density(line, level_setpoint, line.belt_length))
