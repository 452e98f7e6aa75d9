# SPDX-License-Identifier: MIT
"""The target system, and the shift theorem: the closed loop's state without its loop.

    X'(t) = f(X, kappa(X) + w(0, t)),  w_t = lambda(R) w_x,  w(D, t) = 0
    (equation X w)-(boundary condition w), (non tar 1)-(non tar 3)

w is carried out of the belt and nothing comes in, so from sigma(D, 0) on X' = f(X, kappa(X)),
whatever lambda, g and c are; before, X passes through p1(x, 0) at sigma(x, 0). Holds while plant =
model and U is what the law says.
"""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from reference.integral_equations import Nodes, predict
from reference.record import Record

NODE_COUNT = 200


def first_transit(system, history, profile, node_count: int = NODE_COUNT):
    """(sigma(x, 0) [s] (N+1,), p1(x, 0) (n, N+1), its rate f (n, N+1)): the material of time 0.

    history and profile as in mixed_loop.Plant. The march at node_count and at twice as many nodes,
    extrapolated: below 1e-8 for smooth data, against 1e-6 of the march itself.
    """
    record = Record.of(system.speed_window, history, 8 * node_count)
    answers = []
    for count in (node_count, 2 * node_count):
        positions = np.linspace(0.0, system.belt_length, count + 1)
        values = profile(positions) if callable(profile) else profile
        values = np.broadcast_to(values, positions.shape)
        result = predict(system, Nodes(positions), values, record)
        rate = system.f(result.state, system.ode_input(result.speed, result.outlet))
        step = count // node_count
        answers.append([part[..., ::step] for part in (result.arrival, result.state, rate)])
    return tuple((4.0 * fine - coarse) / 3.0 for coarse, fine in zip(*answers, strict=True))


def delay_free(system, start: float, state, times) -> np.ndarray:
    """X (n, M) at times [s] after `start`, from X(start) = state (n,): (non tar 1) with w = 0.

    Error 1e-10 where f and kappa are smooth, 1e-9 over a kink of theirs.
    """
    answer = solve_ivp(
        lambda _time, values: system.f(values, system.kappa(values)),
        (start, max(float(np.max(times)), start)),
        state,
        method="DOP853",
        rtol=1e-11,
        atol=1e-13,
        dense_output=True,
    )
    return answer.sol(times)


def state_of(system, history, profile, times) -> np.ndarray:
    """X (n, M) of the exact closed loop at times [s] (M,)."""
    times = np.asarray(times, dtype=float)
    arrival, state, rate = first_transit(system, history, profile)
    answer = CubicHermiteSpline(arrival, state, rate, axis=1)(times)
    late = times > arrival[-1]
    if late.any():
        answer[:, late] = delay_free(system, arrival[-1], state[:, -1], times[late])
    return answer
