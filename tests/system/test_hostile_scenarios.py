# SPDX-License-Identifier: MIT
"""Files that are no scenario end in exit 2 and one line, in every build, and touch no output.

What each single rule refuses stands in tests/unit/test_scenario_refusals.c; here are whole files.
"""

import os
import random

import pytest

from tests.system.command import SCENARIOS, SHIPPED, assert_refused, belt_sim, names_in

# Those that the build names; the sanitizers' is the one that sees a reader leave its memory.
PROGRAMS = [name for name in ("BELT_SIM", "BELT_SIM_SANITIZE") if name in os.environ]

PAPER = (SCENARIOS / "paper.ini").read_bytes()

HOSTILE = {
    "one_nul": b"\0",
    "nul_inside": PAPER.replace(b"0.3", b"0\0.3"),
    "utf_16": PAPER.decode().encode("utf-16"),
    "byte_order_mark": b"\xef\xbb\xbf" + PAPER,
    "latin_1": b"# \xe9\n" + PAPER,
    "old_mac_line_ends": PAPER.replace(b"\n", b"\r"),
    "vertical_tab": PAPER.replace(b" = ", b"\v=\v"),
    "program": b"\x7fELF" + bytes(range(256)) * 40,
    "long_line": b"[line]\nbelt_length = " + b"1" * 100_000 + b"\n",
    "long_comment": b"#" * 198 + b"\n",
    "comment_that_inih_would_cut_in_two": b"#" * 197 + b"x\nbelt_length = 3\n",
    "long_section": b"[" + b"l" * 190 + b"]\n",
    "long_key": b"[line]\n" + b"k" * 190 + b" = 1\n",
    "too_large": b"\n" * 65_537,
    "much_too_large": PAPER * 2000,
    "sections_without_end": b"[" * 60_000,
    "list_without_end": b"[line]\nloss_rate = " + b"1," * 80 + b"1\n",
    "paper_twice": PAPER + PAPER,
    "cut_in_a_key": PAPER[: PAPER.index(b"speed_window") + 5],
    "cut_before_a_value": PAPER[: PAPER.index(b"speed_window") + 15],
    "json": b'{"line": {"belt_length": 2}}\n',
    "toml_string": b'[line]\nbelt_length = "2"\n',
    "yaml": b"line:\n  belt_length: 2\n",
    "default_section": b"[DEFAULT]\nbelt_length = 2\n",
    "interpolation": b"[line]\nbelt_length = %(processing_time)s\n",
    "format_string": b"[line]\nbelt_length = %s%n%s%n\n",
    "format_string_key": b"[line]\n%s%n = 2\n",
    "format_string_section": b"[%s%n]\n",
    "later_key": b"[controller]\nprofile = off\n",
    "faults_without_end": b"[run]\nfaults = " + b"valve:off@1+1," * 12 + b"valve\n",
    "format_string_fault": b"[run]\nfaults = %s:%n@%s+%n\n",
}


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_file_is_refused_and_no_output_touched(name, program, tmp_path):
    scenario, trace = tmp_path / "hostile.ini", tmp_path / "trace.csv"
    scenario.write_bytes(HOSTILE[name])
    trace.write_text("old")
    result = belt_sim("run", scenario, "--trace", trace, program=program)
    assert_refused(result, str(scenario))
    assert len(result.stderr) < 1000
    assert result.stderr.rstrip("\n").isprintable()
    assert trace.read_text() == "old"
    assert names_in(tmp_path) == ["hostile.ini", "trace.csv"]


@pytest.mark.parametrize("program", PROGRAMS)
def test_empty_file_is_the_paper(program, tmp_path):
    empty = tmp_path / "empty.ini"
    empty.write_bytes(b"")
    result = belt_sim("run", empty, program=program)
    assert result.returncode == 0
    assert result.stdout == belt_sim("run", "paper", program=program).stdout


@pytest.mark.parametrize("name", SHIPPED)
def test_line_ends_do_not_matter(name, tmp_path):
    scenario = tmp_path / "windows.ini"
    scenario.write_bytes((SCENARIOS / f"{name}.ini").read_bytes().replace(b"\n", b"\r\n"))
    assert belt_sim("run", scenario).stdout == belt_sim("run", name).stdout


@pytest.mark.parametrize("program", PROGRAMS)
@pytest.mark.parametrize("seed", range(20))
def test_damaged_file_is_read_or_refused_but_never_crashes(seed, program, tmp_path):
    chance = random.Random(seed)
    text = bytearray((SCENARIOS / f"{chance.choice(SHIPPED)}.ini").read_bytes())
    for _ in range(chance.randrange(1, 5)):
        text[chance.randrange(len(text))] = chance.randrange(256)
    scenario = tmp_path / "damaged.ini"
    scenario.write_bytes(text)
    result = belt_sim("check", scenario, program=program)
    assert result.returncode in (0, 2), result.stderr
    assert (result.stdout == "") == (result.stderr != "")
