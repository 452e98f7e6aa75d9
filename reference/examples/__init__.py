# SPDX-License-Identifier: MIT
"""Worked systems, one a file: what is put in. python -m reference.examples: what comes out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from reference.section2 import BoundaryControl
from reference.section3 import FluxControl


@dataclass(frozen=True)
class Example:
    """A system with its start and how long to watch.

    history: h as a state (n,) that was held or a function of time [s]; profile: u0 as a number or
    a function of position [m]; duration [s]; rest: the state that is wanted, (n,).
    """

    system: BoundaryControl | FluxControl
    history: np.ndarray | Callable
    profile: float | Callable
    duration: float
    rest: tuple[float, ...]
