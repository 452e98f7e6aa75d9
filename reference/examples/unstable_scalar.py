# SPDX-License-Identifier: MIT
"""Section 2 with n = 1: a plant that runs away by itself, recycle of either sign."""

import numpy as np

from reference.examples import Example
from reference.section2 import BoundaryControl

GROWTH, WAVE, DECAY = 0.8, 0.4, 1.5  # [1/s]

SYSTEM = BoundaryControl(
    belt_length=1.0,
    speed_window=0.5,
    f=lambda X, v: GROWTH * X + WAVE * np.sin(X) + v,
    g=lambda x: 0.6 * np.cos(2.0 * x),
    speed=lambda R: 1.0 + 0.5 * np.tanh(R[0]),
    kappa=lambda X: -(GROWTH + DECAY) * X[0] - WAVE * np.sin(X[0]),
)

EXAMPLE = Example(
    system=SYSTEM,
    history=lambda time: np.array([1.0 + 0.5 * time]),
    profile=lambda x: 0.3 * np.sin(3.0 * x),
    duration=4.0,
    rest=(0.0,),
)
