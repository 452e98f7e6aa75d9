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
README = ROOT / "README.md"
PART = re.compile(r"<!-- tools/cost: (\w+) begin -->\n(.*?)<!-- tools/cost: \1 end -->", re.DOTALL)
# Compilers of other versions count a little differently.
DRIFT = 0.03


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    out = tmp_path_factory.mktemp("cost") / "rows.json"
    done = subprocess.run(
        [sys.executable, ROOT / "tools" / "cost", "--quick", "--json", out],
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return json.loads(out.read_text())


@pytest.fixture(scope="module")
def rows(found):
    return {row["mode"]: row for row in found["rows"]}


def table(path, name):
    """The rows of a table that tools/cost has written, each by the names of its columns."""
    text = dict(PART.findall(path.read_text(encoding="utf-8")))[name]
    head, _, *lines = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines()
    ]
    return [dict(zip(head, line, strict=True)) for line in lines]


def stated(name, **fixed):
    """The page's row of each mode with 20 nodes."""
    rows = [row for row in table(PAGE, name) if row.items() >= ({"nodes": "20"} | fixed).items()]
    return {row["mode"]: row for row in rows}


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
    said = stated("costs", target="cortex-m4f")[mode]
    estimated = {"estimate": "cycles", "path_estimate": "its cycles"}
    said_of = {name: said[column] for name, column in names.items()}
    said_of |= {name: stated("estimates")[mode][column] for name, column in estimated.items()}
    for name, number in said_of.items():
        assert rows[mode][name] == pytest.approx(int(number), rel=DRIFT), (
            f"{mode}, {name}: tools/cost --pages"
        )


def test_readme_says_what_the_page_says():
    shown, page = table(README, "costs"), table(PAGE, "costs")
    wanted = [row for row in page if row["nodes"] == "20" and row["mode"] in ("law", "full")]
    assert shown == wanted, "tools/cost --pages writes both"
    assert len({row["target"] for row in shown}) == 9


def test_parts_of_the_flash_are_all_of_it(found):
    said = {row["part"]: int(row["bytes"]) for row in table(PAGE, "flash")}
    all_calls = said.pop("all calls of `belt.h`")
    assert sum(size for part, size in said.items() if part.endswith(".c`")) == all_calls
    assert sum(found["flash"]["objects"].values()) == found["rows"][0]["flash"]
    assert all_calls == int(stated("costs", target="cortex-m4f")["law"]["flash"])


def test_estimate_lies_between_the_manuals_bounds(rows):
    for row in rows.values():
        assert row["instructions_max"] < row["estimate"] < 3 * row["instructions_max"]
        assert row["estimate"] <= row["path_estimate"]


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
