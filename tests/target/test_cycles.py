# SPDX-License-Identifier: MIT
"""The estimate of cycles takes an instruction at what the Cortex-M4's manual says of it."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "target"))
import board  # noqa: E402
import cycles  # noqa: E402
import machine  # noqa: E402


def taken(*lines):
    """Cycles of instructions in a row, without refills of the pipeline."""
    words = [line.partition(" ") for line in lines]
    code = [machine.Instruction(4 * i, name, rest) for i, (name, _, rest) in enumerate(words)]
    return sum(map(cycles.weigher({"code": code}), code))


@pytest.mark.parametrize(
    "line, count",
    [
        ("adds r0, r1, r2", 1),
        ("movcs r0, #1", 1),
        ("mul.w r0, r1, r2", 1),
        ("ldr r0, [r1, #4]", 2),
        ("ldrb.w r0, [r1]", 2),
        ("str r0, [r1, #4]", 1),
        ("str r0, [r1, r2]", 2),
        ("ldrd r0, r1, [r2]", 3),
        ("push {r4, r5, r6, r7, lr}", 6),
        ("vpush {d8-d10}", 7),
        ("vldr s0, [r1]", 2),
        ("vadd.f32 s0, s1, s2", 1),
        ("vdiv.f32 s0, s1, s2", 14),
        ("vmov s0, r1", 2),
        ("vmovgt.f32 s0, s1", 1),
        ("udiv r0, r1, r2", 12),
    ],
)
def test_instruction_alone(line, count):
    assert taken(line) == count


@pytest.mark.parametrize(
    "lines, count",
    [
        # The manual's own examples.
        (["ldr r0, [r1]", "ldr r1, [r2]"], 3),
        (["ldr r0, [r1, r2]", "str r0, [r3, #20]"], 3),
        (["ldr r0, [r1, r2]", "str r1, [r3, r2]"], 3),
        (["ldr r0, [r1, r5]", "ldr r1, [r2]", "ldr r2, [r3, #4]"], 4),
        # Its rules.
        (["ldr r0, [r1]", "ldr r2, [r0]"], 4),
        (["add r0, r1, r2", "ldr r3, [r0]"], 4),
        (["vmul.f32 s0, s1, s2", "vadd.f32 s3, s3, s0"], 3),
        (["vmul.f32 s0, s1, s2", "vadd.f32 s3, s3, s4"], 2),
        (["vsub.f32 s0, s1, s2", "vcmpe.f32 s0, s4"], 3),
    ],
)
def test_instructions_in_a_row(lines, count):
    assert taken(*lines) == count


def test_load_that_a_branch_leads_to_is_not_pipelined():
    assert taken("ldr r0, [r1]", "ldr r1, [r2]", "b.n 4 <code+0x4>") == 5


def test_unknown_instruction_has_no_count():
    with pytest.raises(board.Failure, match="vfrob"):
        taken("vfrob s0, s1")
