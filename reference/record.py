# SPDX-License-Identifier: MIT
"""The past of the ODE state and its integral over the speed window (W), for X in R^n.

`level_history` is the conveyor's own, for one number and one instant at a time; here a whole belt
of predictions is answered at once.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np


def running(times, states) -> np.ndarray:
    """Integral of `states` (n, K) from times[0] on, linear between the `times` (K,); (n, K)."""
    strips = 0.5 * np.diff(times) * (states[:, 1:] + states[:, :-1])
    return np.concatenate([np.zeros((len(states), 1)), np.cumsum(strips, axis=1)], axis=1)


def integral_until(instants, times, states, integrals) -> np.ndarray:
    """The running integral at `instants` (M,) within `times` (K,); (n, M).

    Exact for states linear between the times, so O(spacing^3) off for smooth ones. A time that
    stands twice is an interval of no length.
    """
    before = np.searchsorted(times, instants, side="right") - 1
    before = np.minimum(np.maximum(before, 0), len(times) - 2)
    elapsed, width = instants - times[before], times[before + 1] - times[before]
    share = elapsed / np.where(width > 0.0, width, np.inf)
    rise = states[:, before + 1] - states[:, before]
    return integrals[:, before] + elapsed * (states[:, before] + 0.5 * share * rise)


class Record:
    """X at ascending times, the last of them the present, linear between.

    times [s] (K,), states (n, K) and their running integral (n, K) in units of X times s.
    """

    def __init__(self, speed_window: float, times, states) -> None:
        """speed_window tau [s]; times (K,) from at most now - tau on; states (n, K)."""
        self.speed_window = speed_window
        self.count = len(times)
        self._times = np.array(times, dtype=float)
        self._states = np.array(states, dtype=float)
        self._integrals = running(self._times, self._states)

    @classmethod
    def of(cls, speed_window: float, history: Callable | np.ndarray, pieces: int = 1000) -> Record:
        """The initial history h on [-tau, 0] (initial history, after (initial condition)).

        history: a state (n,) that was held, or a function of the time [s] that gives one.
        """
        times = np.linspace(-speed_window, 0.0, pieces + 1)
        if callable(history):
            states = np.stack([np.atleast_1d(history(time)) for time in times], axis=1)
        else:
            states = np.repeat(np.atleast_1d(np.asarray(history, float))[:, None], pieces + 1, 1)
        return cls(speed_window, times, states)

    @property
    def times(self) -> np.ndarray:
        return self._times[: self.count]

    @property
    def states(self) -> np.ndarray:
        return self._states[:, : self.count]

    @property
    def integrals(self) -> np.ndarray:
        return self._integrals[:, : self.count]

    @property
    def time(self) -> float:
        """The present t [s]."""
        return float(self._times[self.count - 1])

    @property
    def state(self) -> np.ndarray:
        """X(t), shape (n,)."""
        return self._states[:, self.count - 1]

    def append(self, time: float, state) -> None:
        """Record X (n,) at a time [s] not before the present."""
        if self.count == len(self._times):
            room = self.count
            self._times = np.concatenate([self._times, np.zeros(room)])
            blank = np.zeros((len(self._states), room))
            self._states = np.concatenate([self._states, blank], axis=1)
            self._integrals = np.concatenate([self._integrals, blank], axis=1)
        last = self.count - 1
        strip = 0.5 * (time - self._times[last]) * (self._states[:, last] + state)
        self._times[self.count] = time
        self._states[:, self.count] = state
        self._integrals[:, self.count] = self._integrals[:, last] + strip
        self.count += 1

    def window_ahead(self, arrival, state) -> np.ndarray:
        """Integral of X over [arrival - tau, arrival] when X goes on to `state`; (n, M).

        arrival [s]: ascending from the present, shape (M,); state (n, M), `state[:, 0]` = X(t).
        With arrival = sigma and state = p1 this is p3. Both integrals of (equation p_3(x,t)) are
        one: s = sigma(y) makes ds = dy/lambda(p3(y)), and gamma cuts the sum to the window.
        """
        ahead = running(arrival, state)
        start = arrival - self.speed_window
        recorded = integral_until(start, self.times, self.states, self.integrals)
        begun = recorded - self.integrals[:, -1:]
        if start[-1] > arrival[0]:  # the window has left the record behind
            predicted = integral_until(start, arrival, state, ahead)
            begun = np.where(start <= arrival[0], begun, predicted)
        return ahead - begun

    def window(self) -> np.ndarray:
        """Integral of X over the last tau, shape (n,)."""
        now = np.array([self.time])
        return self.window_ahead(now, self.state[:, None])[:, 0]
