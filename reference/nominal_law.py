# SPDX-License-Identifier: MIT
"""The delay-free law: the softened bang-bang u(Q*, Q) of Section 4 and its two gains."""

from __future__ import annotations

from dataclasses import dataclass
from math import expm1, isfinite, log

from scipy.optimize import brentq

from reference.line import Law, Line


@dataclass(frozen=True)
class NominalLaw:
    """A law ready to use, for one set-point.

    hold_flux is Q*/(alpha*service_time) [parts/s], the paper's Q*/alpha; the gains are
    Lambda_l and Lambda_r [1/parts]; setpoint_slope is S = -du/dQ at Q* [1/s].
    """

    level_setpoint: float
    level_capacity: float
    hold_flux: float
    nominal_flux_max: float
    setpoint_slope: float
    gain_below: float
    gain_above: float

    def branch_below(self, level: float) -> float:
        """B_l(Q, Q*) [parts/s], unclamped (bangBl)."""
        shape = expm1(self.gain_below * (level - self.level_setpoint)) / expm1(
            -self.gain_below * self.level_setpoint
        )
        return self.hold_flux + (self.nominal_flux_max - self.hold_flux) * shape

    def branch_above(self, level: float) -> float:
        """B_r(Q, Q*) [parts/s], unclamped (bangBr)."""
        shape = expm1(-self.gain_above * (level - self.level_setpoint)) / expm1(
            -self.gain_above * (self.level_capacity - self.level_setpoint)
        )
        return self.hold_flux * (1.0 - shape)

    def flux(self, level: float) -> float:
        """u(Q*, Q) [parts/s], within [0, nominal_flux_max] (bangbang).

        A level outside [0, level_capacity] counts as the nearer end: the branches leave
        [0, nominal_flux_max] there. At Q = Q* one branch takes the point; both Heavisides of the
        paper would give twice the flux. Raises ValueError for a level that is not a number.
        """
        if not isfinite(level):
            raise ValueError(f"level {level} is not finite")
        level = min(max(level, 0.0), self.level_capacity)
        if level <= self.level_setpoint:
            return self.branch_below(level)
        return self.branch_above(level)


def setpoint_slope_min(line: Line, law: Law) -> float:
    """Smin(Q*) [1/s] (eq:smin)."""
    hold_flux = line.hold_flux(law.level_setpoint)
    below = (law.nominal_flux_max - hold_flux) / law.level_setpoint
    above = hold_flux / (line.level_capacity - law.level_setpoint)
    return max(below, above)


def gain(slope: float, rise: float, width: float) -> float:
    """The positive root Lambda of Lambda*rise = slope*(1 - exp(-Lambda*width)) (eq:lambda_left,
    eq:lambda_right) [1/parts]; slope in 1/s, rise in parts/s, width in parts.

    The difference of the two sides climbs from 0, peaks where exp(-Lambda*width) =
    rise/(slope*width), and is negative from slope/rise on: the root lies between. The bracket ends
    at twice that, where rounding cannot hide the sign.
    Raises ValueError when slope*width <= rise, where 0 is the only root.
    """
    if not slope * width > rise:
        raise ValueError(f"slope {slope} leaves no positive gain: it must exceed {rise / width}")
    peak = log(slope * width / rise) / width

    def excess(candidate: float) -> float:
        return -slope * expm1(-candidate * width) - candidate * rise

    return brentq(excess, peak, 2.0 * slope / rise, xtol=1e-14 * slope / rise, rtol=1e-14)


def nominal_law(line: Line, law: Law) -> NominalLaw:
    """Gains for the set-point, and the law made of them (sq1, sq2, eq:smin).

    Raises ValueError when the set-point is outside 0 < Q* < min(alpha*service_time*Bmax,
    level_capacity), when Bmax is above what the buffer can pass on, or when the slope is not
    above Smin.
    """
    check(line, law)
    hold_flux = line.hold_flux(law.level_setpoint)
    slope = law.setpoint_slope
    if slope is None:
        slope = setpoint_slope_min(line, law) + law.slope_margin
    return NominalLaw(
        level_setpoint=law.level_setpoint,
        level_capacity=line.level_capacity,
        hold_flux=hold_flux,
        nominal_flux_max=law.nominal_flux_max,
        setpoint_slope=slope,
        gain_below=gain(slope, law.nominal_flux_max - hold_flux, law.level_setpoint),
        gain_above=gain(slope, hold_flux, line.level_capacity - law.level_setpoint),
    )


def check(line: Line, law: Law) -> None:
    """Raise ValueError when the law cannot work on the line, naming the rule."""
    ceiling = line.connectivity * line.service_time * law.nominal_flux_max
    if not 0.0 < law.level_setpoint < ceiling:
        raise ValueError(f"level_setpoint {law.level_setpoint} is outside (0, {ceiling})")
    if not law.level_setpoint < line.level_capacity:
        raise ValueError(f"level_setpoint {law.level_setpoint} is not below level_capacity")
    passed_on = min(line.level_capacity / line.service_time, line.service_rate_max)
    if not law.nominal_flux_max <= passed_on / line.connectivity * (1.0 + 1e-12):
        raise ValueError(f"nominal_flux_max {law.nominal_flux_max} exceeds what is served")
