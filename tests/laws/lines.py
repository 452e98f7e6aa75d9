# SPDX-License-Identifier: MIT
"""The lines of this folder's headers in the reference's words."""

from dataclasses import dataclass

import numpy as np

from reference.line import Law, Line
from reference.nominal_law import nominal_law
from reference.section3 import FluxControl
from reference.section4 import nominal_flux

BUSY = 0.2  # v0, density at which half of what would come back does [parts/m]


@dataclass(frozen=True)
class NonlinearRework(Line):
    """nonlinear_rework.h: g(x, v) = 3*A*x*(1 - x/D)*v/(1 + v/v0)."""

    rework_rate: float = 0.8

    def rework(self, position, outlet_density):
        shape = 3.0 * self.rework_rate * position * (1.0 - position / self.belt_length)
        return shape * outlet_density / (1.0 + outlet_density / BUSY)


@dataclass(frozen=True)
class OtherLaws(NonlinearRework):
    """other_laws.h: besides, a speed and a service that bend."""

    def slowness(self, congestion):
        return self.processing_time * (1.0 + congestion / (self.congestion_scale + congestion))

    def service(self, level):
        offered = level / self.service_time
        return offered / (1.0 + offered / self.service_rate_max)

    def hold_flux(self, level_setpoint):
        return self.service(level_setpoint) / self.connectivity


def system_of(line: Line, law: Law) -> FluxControl:
    """The line under its nominal law as a system of Section 3; its laws are the line's."""
    active = nominal_law(line, law)
    service = np.vectorize(line.service, otypes=[float])
    return FluxControl(
        belt_length=line.belt_length,
        speed_window=line.speed_window,
        f=lambda level, outlet_flux: line.connectivity * outlet_flux - service(level),
        g=line.rework,
        c=lambda position: -line.loss(position),
        speed=lambda congestion: line.transport_speed(congestion[0]),
        kappa=lambda level: nominal_flux(active, level[0]),
    )
