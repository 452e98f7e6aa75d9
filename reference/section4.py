# SPDX-License-Identifier: MIT
"""Section 4: the conveyor, as the case of Section 3 that it is, and its law as printed.

    n = 1, X = Q [parts], q = phi [parts/s], u = rho [parts/m]
    f(Q, phi) = alpha*phi - service(Q)                                   (eq buffer1)-(eq buffer3)
    lambda(R) = 1/(P*(1 + R/congestion_scale))                           (after Mp)
    g(x, v) = A*(D - x)*v,  c(x) = -C(x)                                 (Mp3), (Mp4)
    kappa(Q) = u(Q*, Q)                                                  (bangbang)

kappa(0) is not 0: the theorems are used about the set-point, where the line is at rest with
material on it. The modules `line` to `upwind` solve this one case with another discretisation.
"""

from __future__ import annotations

import numpy as np

from reference.integral_equations import Nodes, Prediction
from reference.line import Law, Line
from reference.nominal_law import NominalLaw, nominal_law
from reference.section3 import FluxControl


def nominal_flux(law: NominalLaw, level) -> np.ndarray:
    """u(Q*, Q) [parts/s] (bangbang) for levels [parts] of any shape."""
    level = np.clip(level, 0.0, law.level_capacity)
    below, above = law.gain_below, law.gain_above
    room = law.level_capacity - law.level_setpoint
    share = np.expm1(below * np.minimum(level - law.level_setpoint, 0.0))
    share = share / np.expm1(-below * law.level_setpoint)
    rise = (law.nominal_flux_max - law.hold_flux) * share
    share = np.expm1(-above * np.maximum(level - law.level_setpoint, 0.0))
    fall = law.hold_flux * share / np.expm1(-above * room)
    return law.hold_flux + rise - fall


def conveyor(line: Line, law: Law) -> FluxControl:
    """The line under its nominal law as a system of Section 3."""
    active = nominal_law(line, law)

    def buffer(level, outlet_flux):
        served = np.minimum(level / line.service_time, line.service_rate_max)
        return line.connectivity * outlet_flux - served

    return FluxControl(
        belt_length=line.belt_length,
        speed_window=line.speed_window,
        f=buffer,
        g=line.rework,
        c=lambda position: -line.loss(position),
        speed=lambda congestion: line.transport_speed(congestion[0]),
        kappa=lambda level: nominal_flux(active, level[0]),
    )


# ---- The law as it is printed: P, 1 + p3 and A written out ----


def kernel(line: Line, nodes: Nodes, congestion) -> np.ndarray:
    """K(x, y, t) after (C3): row x, column y, 1 above the diagonal; congestion p3 (N,)."""
    rate = nodes.table(line.loss) * line.slowness(congestion)
    return np.tril(np.exp(-nodes.integral(rate))) + np.triu(np.ones((len(nodes),) * 2), 1)


def inlet_flux_by_c0(
    line: Line, law: NominalLaw, nodes: Nodes, prediction: Prediction, stray: float = 1.0
) -> float:
    """U [parts/s] by (C0), its rework integral times `stray`: 1 is (MF1), P is (C0) as printed."""
    levels, congestion = prediction.state[0], prediction.window[0]
    crowd = 1.0 + congestion / line.congestion_scale
    survival = kernel(line, nodes, congestion)[-1]
    demanded = crowd[-1] * nominal_flux(law, levels[-1]) / (crowd[0] * survival[-1])
    picked_up = line.rework_rate * nodes.positions * prediction.outlet * crowd
    return float(demanded - stray * (nodes.weights[-1] @ (picked_up / (survival * crowd[0]))))


def level_by_c1(line: Line, nodes: Nodes, prediction: Prediction) -> np.ndarray:
    """Right side of (C1) [parts]; (N,)."""
    level, slowness = prediction.state[0], line.slowness(prediction.window[0])
    served = np.minimum(level / line.service_time, line.service_rate_max)
    return level[0] + nodes.integral(line.connectivity * prediction.outlet - slowness * served)


def outlet_by_c2(line: Line, nodes: Nodes, densities, prediction: Prediction) -> np.ndarray:
    """Right side of (C2) [parts/m]; densities rho (N,); (N,)."""
    values = kernel(line, nodes, prediction.window[0])
    own = np.diagonal(values)
    rework = line.rework_rate * (line.belt_length - nodes.reach) * prediction.outlet
    rework = rework * line.slowness(prediction.window[0])
    return own * densities + np.sum(nodes.weights * own[:, None] / values * rework, axis=1)
