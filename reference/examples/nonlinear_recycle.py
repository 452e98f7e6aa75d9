# SPDX-License-Identifier: MIT
"""Section 3 with n = 1: recycle that saturates, friction that damps at one end only.

c(x) = 1.5*cos(pi*x) is positive near the outlet: what is on the way grows there, which no conveyor
does. The plant runs away by itself; the law sees its flux.
"""

import numpy as np

from reference.examples import Example
from reference.norm_equivalence import Constants
from reference.section3 import FluxControl

GROWTH, DECAY = 0.4, 1.6  # [1/s]

SYSTEM = FluxControl(
    belt_length=1.0,
    speed_window=0.5,
    f=lambda X, q: GROWTH * np.sin(X) + q,
    g=lambda x, v: (0.5 + x) * np.tanh(v),
    c=lambda x: 1.5 * np.cos(np.pi * x),
    speed=lambda R: 1.0 + 0.5 * np.tanh(R[0]),
    kappa=lambda X: -GROWTH * np.sin(X[0]) - DECAY * X[0],
)

EXAMPLE = Example(
    system=SYSTEM,
    history=np.array([1.0]),
    profile=lambda x: 0.3 * np.sin(3.0 * x),
    duration=4.0,
    rest=(0.0,),
)

# Theta = X^2: 2*X*f <= 0.8*X^2 + 2*|X*q| <= X^2 + 5*q^2. Under the law X' = -1.6*X + w.
CONSTANTS = Constants(
    belt_length=1.0,
    speed_min=0.5,
    speed_max=1.5,
    lipschitz=1.5,
    growth=1.5 / np.pi,
    loss=1.5 / np.pi,
    lower_inverse=np.sqrt,
    upper=np.square,
    gain=lambda s: 5.0 * s**2,
    law_growth=lambda s: (GROWTH + DECAY) * s,
    stable=lambda size, sup_w: size + sup_w / DECAY,
)
