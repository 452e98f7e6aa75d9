# SPDX-License-Identifier: MIT
"""What a step costs on a Cortex-M4F is what the page says, and within its bars."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "COST.md"
# Compilers of other versions count a little differently.
DRIFT = 0.03


@pytest.fixture(scope="module")
def rows(tmp_path_factory):
    out = tmp_path_factory.mktemp("cost") / "rows.json"
    found = subprocess.run(
        [sys.executable, ROOT / "tools" / "cost", "--quick", "--json", out],
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr
    return {row["mode"]: row for row in json.loads(out.read_text())["rows"]}


def stated():
    """The page's row of each mode for a Cortex-M4F with 20 nodes."""
    lines = [
        line.strip("| \n").split(" | ") for line in PAGE.read_text().splitlines() if "|" in line
    ]
    head = next(line for line in lines if line[0] == "target")
    table = [dict(zip(head, line)) for line in lines if len(line) == len(head)]
    return {
        row["mode"]: row for row in table if (row["target"], row["nodes"]) == ("cortex-m4f", "20")
    }


def test_all_modes_are_there(rows):
    assert list(rows) == ["law", "full", "profile", "late"]
    for row in rows.values():
        assert (row["target"], row["node_count"]) == ("cortex-m4f", 20)
        assert 0 < row["instructions_min"] <= row["instructions_max"] <= row["path"]
        assert row["steps"] > 100


@pytest.mark.parametrize("mode", ["law", "full", "profile", "late"])
def test_page_says_what_is_measured(rows, mode):
    names = {"instructions_max": "greatest", "path": "path", "flash": "flash"}
    names |= {"ram": "RAM", "stack": "stack"}
    for key, name in names.items():
        said = int(stated()[mode][name])
        assert rows[mode][key] == pytest.approx(said, rel=DRIFT), (
            f"{mode}, {name}: tools/cost --page"
        )


def test_library_has_no_state_of_its_own(rows):
    assert rows["law"]["data_and_bss"] == 0


def test_bars(rows):
    law, full = rows["law"], rows["full"]
    assert full["instructions_max"] <= 6000
    assert law["instructions_max"] <= 4500
    assert law["instructions_max"] <= 1.25 * law["instructions_min"]
    assert law["ram"] <= 3072
    for row in rows.values():
        assert row["path"] <= 2.0 * row["instructions_max"]


def test_stack_goes_down_the_calls(rows):
    assert rows["law"]["stack_way"][0] == "belt_step"
    frames = subprocess.run(
        ["arm-none-eabi-objdump", "-d", ROOT / "build" / "cortex-m4f" / "belt_server"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    for name in rows["law"]["stack_way"]:
        assert re.search(rf"<{name}>:", frames)
