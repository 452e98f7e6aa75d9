# SPDX-License-Identifier: MIT
"""All numbers of the line wrong at once by up to 20 %: what must hold in each of some cases.

The bars stand beside what 1,500 cases gave (tests.assurance.mismatch); here are the first 40.
"""

import pytest

from tests.assurance import mismatch

SEED = 20200525
COUNT = 40

# Greatest level [parts] of a buffer of 1; 0.41 and 0.47 are the worst of 1,500 cases.
TOP = {"paper": 0.45, "heavy_window": 0.55}
# What moves in the last 5 s, oscillating or not; 0.00101 and 0.268 are the worst of 1,500.
SWING = {"paper": 2e-3, "heavy_window": 0.4}
# The project's bar for a line whose model is wrong; 5e-5 and 3e-4 are the worst of 1,500.
FINAL = 1e-3
# None and 6 of the first 40 oscillate, 0.07 % and 15 % of 1,500: P D is wrong by up to 44 % here.
SHARE = {"paper": 0.0, "heavy_window": 0.2}


@pytest.fixture(scope="module", params=["paper", "heavy_window"])
def found(request):
    return request.param, mismatch.numbers(mismatch.cases(request.param, COUNT, SEED))


def test_level_is_bounded_whatever_is_wrong(found):
    line, cases = found
    for case in cases:
        assert case["spilled"] == 0, case
        assert case["top"] <= TOP[line], case
        assert case["swing"] <= SWING[line], case


def test_what_does_not_oscillate_ends_at_the_set_point(found):
    _, cases = found
    for case in cases:
        if case["swing"] <= mismatch.SWING:
            assert case["final_error"] <= FINAL, case


def test_share_that_oscillates_is_the_published_one(found):
    line, cases = found
    share = mismatch.oscillating(cases)
    print(f"{line}: {share:.3g} of {len(cases)} oscillate")
    assert share <= SHARE[line]


def test_factors_fill_their_range_and_hang_on_seed_and_index_alone():
    rows = mismatch.cases("paper", 4, SEED, first=30)
    assert rows == mismatch.cases("paper", 6, SEED, first=28)[2:]
    assert rows != mismatch.cases("paper", 4, SEED + 1, first=30)
    factors = [case[name] for case in mismatch.numbers(rows) for name in mismatch.FACTORS]
    assert 0.8 <= min(factors) < 0.85 and 1.15 < max(factors) < 1.2


def test_resumed_campaign_leaves_the_same_bytes(tmp_path):
    whole, cut = tmp_path / "whole", tmp_path / "cut"
    rows = mismatch.campaign("paper", 5, SEED, whole)
    text = whole.read_bytes()
    for end in (0, 1, len(text) // 2, len(text) - 1, len(text)):
        cut.write_bytes(text[:end])
        assert mismatch.campaign("paper", 5, SEED, cut) == rows
        assert cut.read_bytes() == text
