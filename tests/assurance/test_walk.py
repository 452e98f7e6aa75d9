# SPDX-License-Identifier: MIT
"""Random walks through modes and faults: the controller does what the headers and modes.h say.

hypothesis makes up the walks, the same ones each time; belt_walk goes them with the controller,
supervision.Oracle with the headers' words; every answer must be the same.
"""

import math
import os
import subprocess
from collections import Counter

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.assurance.supervision import ERROR, HAS, HEALTHS, MODES, TABLE, Oracle, Row

GRID = 1024  # levels are multiples of 1/GRID
# float32 in the controller, double here: some roundings of fluxes of up to 2.5
CLOSE = 2e-6

# What happens to the level or the other inputs for some periods on end.
KINDS = [
    "good",
    "good",
    "good",
    "good",
    "missing",
    "nan",
    "infinite",
    "stale",
    "below",
    "above",
    "jump",
    "flicker",
    "uncounted",
    "untimed",
    "late",
    "lost",
    "repeated",
    "valve_off",
    "valve_bad",
    "valve_good",
]

SEGMENT = st.tuples(
    st.sampled_from(KINDS),
    st.integers(1, 24),  # periods
    st.integers(-20, 20),  # the level's rise each period [1/GRID]
    st.sampled_from([-1, -1, -1, 0, 1, 2, 2, 2, 3, 4, 9]),  # asked at its beginning
    st.sampled_from([math.nan, math.nan, 0.0, 0.5, 2.5, 2.625, -0.125, math.inf]),
    st.integers(2, 9) | st.sampled_from([99, 100]),  # ticks, where it comes late
)
WALK = st.lists(SEGMENT, min_size=12, max_size=40)


def spoil(row, kind, index, ticks):
    """Lays a fault over a good row."""
    has = HAS
    if kind == "missing":
        row.present &= ~has["LEVEL"]
    elif kind in ("nan", "infinite"):
        row.level = math.nan if kind == "nan" else -math.inf
    elif kind in ("below", "above"):
        row.level = -1 / GRID if kind == "below" else 1 + index / 64
    elif kind == "jump":
        row.level = 0.75 if row.level < 0.5 else 0.125
    elif kind == "flicker":
        row.level = 0.875 if index % 2 else 0.0
    elif kind == "uncounted":
        row.present &= ~has["SAMPLE_COUNT"]
    elif kind == "untimed":
        row.present &= ~has["ELAPSED_TICKS"]
        row.elapsed_ticks = 77
    elif kind in ("late", "lost", "repeated"):
        row.elapsed_ticks = {"late": ticks, "lost": 101 + 1000 * index, "repeated": 0}[kind]
    elif kind.startswith("valve"):
        row.present |= has["APPLIED_FLUX"]
        row.echo = int(kind == "valve_good")
        row.applied_flux = 4.0 if kind == "valve_off" else (math.nan, -1.0, 1e30)[index % 3]


def rows_of(walk):
    rows = []
    height, sample = 256, 2**32 - 200  # the count wraps
    for kind, length, rise, asked, flux, ticks in walk:
        for index in range(length):
            height = min(max(height + rise, 0), GRID)
            if kind != "stale":
                sample = (sample + 1) % 2**32
            row = Row(level=height / GRID, sample_count=sample)
            if index == 0:
                row.asked, row.manual_flux = asked, flux
            spoil(row, kind, index, ticks)
            rows.append(row)
    return rows


def answers(rows):
    text = "".join(row.text() for row in rows)
    command = [os.environ["BELT_WALK"]]
    result = subprocess.run(command, input=text, capture_output=True, text=True, timeout=60)
    assert result.returncode == 0, result.stderr
    first, *lines = result.stdout.splitlines()
    pairs = first.split()
    config = {name: float(value) for name, value in zip(pairs[::2], pairs[1::2])}
    assert len(lines) == len(rows)
    return config, [line.split() for line in lines]


def check_step(oracle, row, answer, seen):
    """One row against its answer; the oracle then goes on from the controller's last command."""
    of_mode, of_flux, status, mode, bits, health, *numbers = answer
    flux, law_flux, bump, disturbance = map(float, numbers)
    assert of_mode == (oracle.ask(row.asked) if row.asked >= 0 else "BELT_OK")
    is_flux_asked = not math.isnan(row.manual_flux)
    assert of_flux == (oracle.ask_flux(row.manual_flux) if is_flux_asked else "BELT_OK")

    oracle.found = set()
    was_running = oracle.level is not None
    periods = oracle.periods(row)
    is_taken = False
    if periods > 0 or not was_running:  # a repeated step reads nothing
        is_taken = oracle.takes_level(row, periods)
        oracle.judge(is_taken, periods)
        oracle.check_valve(row)
    is_running = was_running or is_taken
    limit = oracle.config["connectivity"] * oracle.config["nominal_flux_max"]
    if is_running and abs(disturbance) >= limit * (1 - 1e-6):
        oracle.found.add("DISTURBANCE_LIMIT")
    assert int(bits) == sum(ERROR[name] for name in oracle.found), oracle.found
    assert HEALTHS[int(health)] == oracle.health
    assert status == oracle.status(is_running)

    last = oracle.flux
    if periods > 0:
        taken = oracle.decide(oracle.event(is_running), law_flux)
        seen[taken] += 1
        if TABLE[taken][1] == "BUMPLESS":
            assert abs(flux - last) <= CLOSE
    assert MODES[int(mode)] == oracle.mode
    assert abs(flux - oracle.flux) <= CLOSE
    assert abs(bump - oracle.bump) <= CLOSE
    assert 0 <= flux <= oracle.config["inlet_flux_max"]
    assert abs(flux - last) <= oracle.config["flux_rate_max"] * oracle.config["period"] + CLOSE
    oracle.flux, oracle.bump = flux, bump


def test_walks_through_modes_and_faults_go_where_the_headers_say():
    seen = Counter()

    @settings(max_examples=600, derandomize=True, deadline=None, database=None)
    @given(WALK)
    def go(walk):
        rows = rows_of(walk)
        config, found = answers(rows)
        oracle = Oracle(config, good=int(config["recovery_samples"]))
        for row, answer in zip(rows, found):
            check_step(oracle, row, answer, seen)

    go()
    print(f"{sum(seen.values())} steps:", *(f"{row}: {seen[row]}" for row in TABLE), sep="\n")
    assert set(seen) == set(TABLE), "every row of the table is walked"
    assert len(TABLE) == 25
    assert sum(seen.values()) >= 100_000


def test_oracle_refuses_an_answer_that_is_wrong_in_any_word():
    rows = rows_of([("good", 24, 1, -1, math.nan, 2), ("missing", 24, 0, -1, math.nan, 2)])
    config, found = answers(rows)
    changes = [(2, "BELT_NO_LEVEL"), (3, "0"), (4, "3"), (5, "1"), (6, "2.25"), (8, "1.5")]
    for word, wrong in changes:
        spoiled = [list(answer) for answer in found]
        spoiled[12][word] = wrong
        oracle = Oracle(config, good=int(config["recovery_samples"]))
        is_refused = False
        for row, answer in zip(rows, spoiled):
            try:
                check_step(oracle, row, answer, Counter())
            except AssertionError:
                is_refused = True
                break
        assert is_refused, word
