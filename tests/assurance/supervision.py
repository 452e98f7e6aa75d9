# SPDX-License-Identifier: MIT
"""What gate and supervisor promise, in Python, from the headers' words and the table of modes.h.

Shares nothing with the C but that table. Levels are multiples of 2^-10, so that every comparison is
exact in float32 too.
"""

import math
import re
from dataclasses import dataclass, field
from pathlib import Path

BELT = Path(__file__).resolve().parents[2] / "firmware" / "belt"


def transitions():
    """(mode, event) -> (mode, transfer), the rows of BELT_TRANSITIONS."""
    text = (BELT / "modes.h").read_text().split("#define BELT_TRANSITIONS(row)")[1]
    text = text.replace("\\\n", " ").split("#endif")[0]
    rows = re.findall(r"row\(\s*([A-Z]+),\s*([A-Z]+),\s*([A-Z]+),\s*([A-Z_]+)\s*\)", text)
    return {(mode, event): (to, transfer) for mode, event, to, transfer in rows}


def words(name):
    """The words of an enumeration in order, without their common beginning."""
    text = (BELT / "modes.h").read_text() + (BELT / "measurement.h").read_text()
    body = re.search(r"typedef enum \{([^{}]*)\} " + name + ";", text)[1]
    return re.findall(r"\bBELT_(?:MODE|LEVEL)_(\w+)", re.sub(r"/\*.*?\*/", "", body, flags=re.S))


def constants(begin):
    """The BELT_<begin>_... constants of measurement.h."""
    text = (BELT / "measurement.h").read_text()
    found = re.findall(rf"#define BELT_{begin}_(\w+) (0x[0-9A-Fa-f]+|\d+)u", text)
    return {name: int(value, 0) for name, value in found}


TABLE = transitions()
MODES = words("belt_mode_t")
HEALTHS = words("belt_level_health_t")
ERROR = constants("ERROR")
HAS = constants("HAS")
CATCH_UP = 100  # BELT_CATCH_UP_PERIODS
LEVEL_MARGIN = 0.1  # BELT_LEVEL_MARGIN; no level of a walk stands at the very edge
LEVEL_IS_BAD = ("LEVEL_MISSING", "LEVEL_INVALID", "LEVEL_STALE", "LEVEL_STEP", "PERIODS_LOST")
LINE = ("FLUX_MISMATCH", "DISTURBANCE_LIMIT")
PERIODS = ("PERIODS_LATE", "PERIODS_LOST", "PERIOD_REPEATED", "HISTORY_SHORT")


@dataclass
class Row:
    """What happens before and in one step."""

    asked: int = -1
    manual_flux: float = math.nan
    present: int = HAS["LEVEL"] | HAS["SAMPLE_COUNT"] | HAS["ELAPSED_TICKS"]
    level: float = 0.25
    sample_count: int = 0
    elapsed_ticks: int = 1
    applied_flux: float = 0.0
    echo: int = 0

    def text(self):
        return (
            f"{self.asked} {self.manual_flux} {self.present} {self.level!r} {self.sample_count} "
            f"{self.elapsed_ticks} {self.applied_flux!r} {self.echo}\n"
        )

    def has(self, name):
        return bool(self.present & HAS[name])


@dataclass
class Oracle:
    """The controller as its headers describe it; `config` are belt_walk's own numbers."""

    config: dict
    requested: str = "AUTOMATIC"
    mode: str = "OFF"
    flux: float = 0.0
    manual: float = 0.0
    bump: float = 0.0
    health: str = "TRUSTED"
    level: float | None = None
    elsewhere: float = 0.0
    agreeing: int = 0
    sample: int = 0
    age: int = 0
    good: int = 0
    regained: int = 0
    bad: int = 0
    mismatch: int = 0
    found: set = field(default_factory=set)

    def ask(self, mode):
        if mode not in range(3):
            return "BELT_UNKNOWN_MODE"
        if MODES[mode] == "MANUAL" != self.requested:
            self.manual = self.flux
        self.requested = MODES[mode]
        return "BELT_OK"

    def ask_flux(self, flux):
        if self.requested != "MANUAL":
            return "BELT_NOT_MANUAL"
        if not 0 <= flux <= self.config["inlet_flux_max"]:
            return "BELT_MANUAL_FLUX"
        self.manual = flux
        if self.mode == "MANUAL":
            self.bump = 0.0
        return "BELT_OK"

    def periods(self, row):
        elapsed = row.elapsed_ticks if row.has("ELAPSED_TICKS") else 1
        if elapsed == 0:
            self.found.add("PERIOD_REPEATED")
        elif elapsed > CATCH_UP:
            self.found.add("PERIODS_LOST")
        elif elapsed > 1:
            self.found.add("PERIODS_LATE")
        return min(elapsed, CATCH_UP)

    def is_new_sample(self, row, periods):
        counted = row.has("SAMPLE_COUNT")
        is_new = not counted or self.level is None or row.sample_count != self.sample
        self.age = 0 if is_new else self.age + periods
        if counted:
            self.sample = row.sample_count
        if self.age >= self.config["sample_periods"]:
            self.found.add("LEVEL_STALE")
        return is_new

    def is_believed(self, level):
        reach = self.config["level_step_max"]
        if self.level is None or abs(level - self.level) <= reach:
            self.agreeing = 0
            return True
        agrees = abs(level - self.elsewhere) <= reach
        self.agreeing = self.agreeing + 1 if agrees else 1
        self.elsewhere = level
        if self.agreeing < self.config["recovery_samples"]:
            return False
        self.agreeing = 0
        self.good = self.config["recovery_samples"]
        return True

    def takes_level(self, row, periods):
        """Whether this period brings a level that is trusted."""
        if not row.has("LEVEL"):
            self.age += periods
            if self.age >= self.config["sample_periods"]:
                self.found.add("LEVEL_MISSING")
            return False
        capacity = self.config["level_capacity"]
        if not -LEVEL_MARGIN * capacity <= row.level <= (1 + LEVEL_MARGIN) * capacity:
            self.found.add("LEVEL_INVALID")
            self.agreeing = 0
            return False
        if not self.is_new_sample(row, periods):
            return False
        if not 0 <= row.level <= capacity:
            self.found.add("LEVEL_RANGE")
        if not self.is_believed(row.level):
            self.found.add("LEVEL_STEP")
            return False
        if self.level is None:
            self.good = self.config["recovery_samples"]
        self.level = min(max(row.level, 0.0), capacity)
        return True

    def judge(self, is_taken, periods):
        if self.found & set(LEVEL_IS_BAD):
            self.good = 0
            # late with a good sample: that one is doubted, and no more is known to be bad
            self.bad += 1 if is_taken else periods
            if self.bad > self.config["hold_periods"]:
                self.regained = 0
                self.health = "LOST"
            elif self.health != "LOST":
                self.health = "DOUBTED"
        elif is_taken:
            self.bad = 0
            self.good += 1
            self.regained += 1
            if self.good >= self.config["recovery_samples"] or self.health == "TRUSTED":
                self.health = "TRUSTED"
            elif self.regained >= self.config["recovery_samples"]:
                self.health = "DOUBTED"

    def check_valve(self, row):
        if not row.has("APPLIED_FLUX"):
            self.mismatch = 0
            return
        applied = self.flux if row.echo else row.applied_flux
        if not 0 <= applied <= 1e3:  # the walk's values are far from the bound on either side
            self.found.add("APPLIED_FLUX_INVALID")
            return
        is_near = abs(applied - self.flux) <= 0.05 * self.config["nominal_flux_max"]
        self.mismatch = 0 if is_near else self.mismatch + 1
        if self.mismatch >= 5:
            self.found.add("FLUX_MISMATCH")

    def event(self, is_running):
        if self.requested == "AUTOMATIC":
            return self.health if is_running else "OFF"
        return self.requested

    def decide(self, event, law_flux):
        """Mode and command from the last ones; returns the row of the table that was taken."""
        taken = (self.mode, event)
        self.mode, transfer = TABLE[taken]
        own = {
            "OFF": 0.0,
            "MANUAL": self.manual,
            "AUTOMATIC": law_flux,
            "HOLD": law_flux,
            "SUBSTITUTE": self.config["substitute_flux"],
        }[self.mode]
        if transfer == "NONE":
            is_seen = abs(self.bump) > 1e-6 * self.config["nominal_flux_max"]
            kept = math.exp(-self.config["period"] / self.config["transfer_time"])
            self.bump = self.bump * kept if is_seen else 0.0
        else:
            self.bump = self.flux - own if transfer == "BUMPLESS" else 0.0
        step = self.config["flux_rate_max"] * self.config["period"]
        wanted = min(max(own + self.bump, self.flux - step), self.flux + step)
        self.flux = min(max(wanted, 0.0), self.config["inlet_flux_max"])
        return taken

    def status(self, is_running):
        if not is_running:
            return "BELT_NO_LEVEL"
        if self.found - set(LINE) - set(PERIODS):
            return "BELT_INPUT_REJECTED"
        if self.found & set(PERIODS):
            return "BELT_PERIODS_MISSED"
        return "BELT_LINE_DEVIATES" if self.found else "BELT_OK"
