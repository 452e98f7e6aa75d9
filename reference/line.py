# SPDX-License-Identifier: MIT
"""The line: a belt whose speed depends on how full the buffer at its end has been.

    buffer   Q'(t) = connectivity * outlet_flux(t) - service(Q)                      (eq buffer1-3)
    belt     rho_t = transport_speed * rho_x + rework(x, rho(0, t)) - loss(x) * rho  (Mp, Mp3, Mp4)
    ends     outlet_flux = transport_speed * rho(0, t),  inlet_flux = transport_speed * rho(D, t)
    speed    transport_speed = 1 / (P * (1 + R / congestion_scale)), R = window integral of Q

Material enters at x = belt_length and leaves at x = 0. Every quantity that names a place on the
belt is measured from the outlet.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

import numpy as np


@dataclass(frozen=True)
class Line:
    """The physical line; the defaults are the paper's simulation (Section 5).

    belt_length [m], processing_time [s/m], speed_window [s], congestion_scale [parts s],
    connectivity [-], service_rate_max [parts/s], service_time [s], level_capacity [parts],
    rework_rate [1/(m s)], loss_rate [1/s]: values equally spaced from outlet to inlet, ends
    included, linear between; one value is a uniform loss; below 0 density grows by itself.

    congestion_scale and service_time are 1 in the paper and invisible in its formulas.
    Raises ValueError for anything that is not finite or out of range.
    """

    belt_length: float = 2.0
    processing_time: float = 0.25
    speed_window: float = 0.2
    congestion_scale: float = 1.0
    connectivity: float = 0.5
    service_rate_max: float = 0.8
    service_time: float = 1.0
    level_capacity: float = 1.0
    rework_rate: float = 0.1
    loss_rate: tuple[float, ...] = (1.0,)

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            values = value if name == "loss_rate" else (value,)
            for number in values:
                in_range = (
                    number > 0 or name == "loss_rate" or (number == 0 and name == "rework_rate")
                )
                if not isfinite(number) or not in_range:
                    raise ValueError(f"{name} = {number} is out of range")
        if len(self.loss_rate) == 0:
            raise ValueError("loss_rate needs at least one value")

    def slowness(self, congestion):
        """1/omega(R) = P*(1 + R/congestion_scale) [s/m]; congestion in parts s, any shape."""
        return self.processing_time * (1.0 + congestion / self.congestion_scale)

    def transport_speed(self, congestion):
        """omega(R), lambda(p3) [m/s]; congestion in parts s, any shape (eq after Mp)."""
        return 1.0 / self.slowness(congestion)

    def service(self, level: float) -> float:
        """min(Q/service_time, mu) [parts/s]: what the buffer gives away (eq buffer3)."""
        return min(level / self.service_time, self.service_rate_max)

    def rework(self, position, outlet_density):
        """g(x, v) = A*(D - x)*v [parts/(m s)], any shape (Mp3)."""
        return self.rework_rate * (self.belt_length - position) * outlet_density

    def loss(self, position):
        """C(x) [1/s] at the positions [m] given, any shape (Mp4); the ends go on outside."""
        return profile(self.loss_rate, self.belt_length, position)

    def hold_flux(self, level_setpoint: float) -> float:
        """Outlet flux that keeps the buffer at the set-point [parts/s]; Q*/alpha in the paper."""
        return level_setpoint / (self.connectivity * self.service_time)


@dataclass(frozen=True)
class Law:
    """What the user asks of the nominal law; the defaults are the paper's.

    level_setpoint Q* [parts], nominal_flux_max Bmax [parts/s], and either slope_margin, the slope
    above its least admissible value [1/s], or setpoint_slope, the slope S itself [1/s].
    """

    level_setpoint: float = 0.3
    nominal_flux_max: float = 1.2
    slope_margin: float = 20.0
    setpoint_slope: float | None = None


def profile(values, belt_length: float, position):
    """Values equally spaced from outlet to inlet, linear between, at the positions [m] given."""
    values = np.atleast_1d(np.asarray(values, dtype=float))
    if values.size == 1:
        return np.full(np.shape(position), values[0])
    knots = np.linspace(0.0, belt_length, values.size)
    return np.interp(position, knots, values)
