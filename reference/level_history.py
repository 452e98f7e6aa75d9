# SPDX-License-Identifier: MIT
"""The recorded level, and the congestion: its integral over the speed window (eq after Mp, W)."""

from __future__ import annotations

from bisect import bisect_right


class LevelHistory:
    """Levels [parts] at ascending times [s], linear between, and their running integral.

    The weight gamma of the paper selects [sigma - speed_window, sigma]: here that is a difference
    of two running integrals, harmless in double precision.
    """

    def __init__(self, speed_window: float, times, levels) -> None:
        self.speed_window = speed_window
        self.times = [times[0]]
        self.levels = [levels[0]]
        self.integrals = [0.0]
        for time, level in zip(times[1:], levels[1:], strict=True):
            self.append(time, level)

    @classmethod
    def constant(cls, speed_window: float, time: float, level: float) -> LevelHistory:
        """A history that stood at one level until the time given."""
        return cls(speed_window, [time - speed_window, time], [level, level])

    def append(self, time: float, level: float) -> None:
        """Record a level at a time not before the last one."""
        self.integrals.append(self.integral_if(time, level))
        self.times.append(time)
        self.levels.append(level)

    def integral_if(self, time: float, level: float) -> float:
        """Running integral [parts s] at `time`, should the level go linearly to `level`."""
        return self.integrals[-1] + 0.5 * (time - self.times[-1]) * (self.levels[-1] + level)

    def integral_until(self, time: float) -> float:
        """Running integral [parts s] at a recorded time; before the record, the first level."""
        times, levels = self.times, self.levels
        before = min(max(bisect_right(times, time) - 1, 0), len(times) - 2)
        elapsed = time - times[before]
        width = times[before + 1] - times[before]
        rise = levels[before + 1] - levels[before]
        slope = rise / width if width > 0.0 and elapsed > 0.0 else 0.0
        return self.integrals[before] + elapsed * (levels[before] + 0.5 * slope * elapsed)

    def congestion(self) -> float:
        """R(t) [parts s] at the last recorded time."""
        return self.integrals[-1] - self.integral_until(self.times[-1] - self.speed_window)

    def congestion_if(self, time: float, level: float) -> float:
        """R [parts s] at a later time, should the level go linearly from the last one to `level`.

        This is p3 of (MF5) when `level` is p1 and `time` is sigma.
        """
        start = time - self.speed_window
        if start <= self.times[-1]:
            return self.integral_if(time, level) - self.integral_until(start)
        share = self.speed_window / (time - self.times[-1])
        return self.speed_window * (level - 0.5 * share * (level - self.levels[-1]))

    def recent(self) -> LevelHistory:
        """A copy of the part that the window can still reach."""
        first = bisect_right(self.times, self.times[-1] - self.speed_window) - 1
        first = min(max(first, 0), len(self.times) - 2)
        copy = LevelHistory.__new__(LevelHistory)
        copy.speed_window = self.speed_window
        copy.times = self.times[first:]
        copy.levels = self.levels[first:]
        copy.integrals = self.integrals[first:]
        return copy
