# SPDX-License-Identifier: MIT
"""Section 2 with n = 2: a pendulum upside down, X = (angle [rad], its rate [rad/s]).

The speed of the belt depends on the integrals of both. The law cancels the weight and leaves a
spring and a damper.
"""

import numpy as np

from reference.examples import Example
from reference.section2 import BoundaryControl

WEIGHT, FRICTION = 2.0, 0.2
SPRING, DAMPER = 4.0, 3.0

SYSTEM = BoundaryControl(
    belt_length=1.0,
    speed_window=0.6,
    f=lambda X, v: np.stack([X[1], WEIGHT * np.sin(X[0]) - FRICTION * X[1] + v]),
    g=lambda x: 0.5 - 0.8 * x,
    speed=lambda R: 1.2 + 0.4 * np.tanh(R[0]) - 0.3 * np.tanh(R[1]),
    kappa=lambda X: -WEIGHT * np.sin(X[0]) - SPRING * X[0] - DAMPER * X[1],
)

EXAMPLE = Example(
    system=SYSTEM,
    history=np.array([0.4, 0.0]),
    profile=0.0,
    duration=5.0,
    rest=(0.0, 0.0),
)
