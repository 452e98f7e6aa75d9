# SPDX-License-Identifier: MIT
"""Appendix A: the K-infinity functions of Lemmas 11 and 12, as numbers.

The proofs hold with four corrections, each shown by a test: in (wunorm) the first term carries
lambda_max*K1, not K1/epsilon, and the last the length D of its integral; G3(lambda*s) is not
lambda_1*G3(s) for every K-infinity function, so it stays inside; and the comparison equation
(Z(X)) may end before D, so pi1 is bounded by input-to-state stability (ISSE) instead.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Constants:
    """What the assumptions grant a system of Section 3.

    belt_length D [m]; speed_min epsilon, speed_max (eqlam) [m/s]; lipschitz L_g [1/s] (Assumption
    3); growth, loss: integrals over the belt of max(c, 0) and max(-c, 0) [m/s]; of (equation 7),
    (equation 8): lower_inverse G1^-1, upper G2, gain G3; law_growth rho (ieq rho); stable(|X|,
    |w|): what (ISSE) bounds |X| by at any time.
    """

    belt_length: float
    speed_min: float
    speed_max: float
    lipschitz: float
    growth: float
    loss: float
    lower_inverse: Callable
    upper: Callable
    gain: Callable
    law_growth: Callable
    stable: Callable

    @property
    def kernel_max(self) -> float:
        """A K1 and K2 for all times (K1), (K2) [-]."""
        return float(np.exp(self.growth / self.speed_min))

    @property
    def inverse_kernel_max(self) -> float:
        """An L bar (overlineL) [-]."""
        return float(np.exp(self.loss / self.speed_min))

    def outlet_bound(self, sup_u):
        """sup |p2| (p2norm)."""
        rate = self.kernel_max * self.lipschitz / self.speed_min
        return self.kernel_max * sup_u * np.exp(rate * self.belt_length)

    def state_bound(self, size, sup_outlet):
        """sup |p1| (p1norm), G3 taken of lambda_max*|p2|; size |X(t)|."""
        grown = np.exp(self.belt_length / self.speed_min)
        gain = self.gain(self.speed_max * sup_outlet)
        return self.lower_inverse(grown * self.upper(size) + (grown - 1.0) * gain)

    def transformation_bound(self, size, sup_u):
        """sup |w| (wunorm), corrected; with size = sup_u = s a K3(s) of Lemma 11."""
        sup_outlet = self.outlet_bound(sup_u)
        gathered = self.belt_length * self.kernel_max * self.lipschitz / self.speed_min
        law = self.law_growth(self.state_bound(size, sup_outlet))
        return self.speed_max * (self.kernel_max * sup_u + gathered * sup_outlet) + law

    def transformation_bound_as_printed(self, size, sup_u):
        """The right side of (wunorm) as printed."""
        sup_outlet = self.outlet_bound(sup_u)
        law = self.law_growth(self.state_bound(size, sup_outlet))
        gathered = self.speed_max * self.kernel_max / self.speed_min * self.lipschitz * sup_outlet
        return self.kernel_max / self.speed_min * sup_u + law + gathered

    def inverse_bound(self, size, sup_w):
        """sup |u| (lemma13_5), pi1 from (ISSE); with size = sup_w = s a K4(s) of Lemma 12."""
        demanded = sup_w + self.law_growth(self.stable(size, sup_w))
        gathered = self.belt_length * self.lipschitz * demanded / self.speed_min
        return self.inverse_kernel_max / self.speed_min * (demanded + gathered)
