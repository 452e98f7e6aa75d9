# SPDX-License-Identifier: MIT
"""Section 4 with the numbers of Section 5: an empty line is to hold 0.3 parts."""

import numpy as np

from reference.examples import Example
from reference.line import Law, Line
from reference.section4 import conveyor

LINE, LAW = Line(), Law()

EXAMPLE = Example(
    system=conveyor(LINE, LAW),
    history=np.array([0.0]),
    profile=0.0,
    duration=2.5,
    rest=(LAW.level_setpoint,),
)
