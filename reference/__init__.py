# SPDX-License-Identifier: MIT
"""The paper in numpy, in the order of the paper: the independent judge of the controller."""
