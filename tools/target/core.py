# SPDX-License-Identifier: MIT
"""Cycles of each belt_step on the processor core CV32E40P, simulated in Verilator.

The core comes as SystemVerilog in a package of PyPI. Here it has its FPU, without registers in its
pipelines, and a memory that answers in the next cycle.
"""

import re
import struct
import tempfile
from pathlib import Path

import board
import counting
import machine

TARGET = "cv32e40p"
PRESET = "rv32imafc"  # of its programs; the core lacks the atomic instructions, which none has
PACKAGE = "pythondata_cpu_cv32e40p"
FOLDER = board.ROOT / "build" / "target" / TARGET
BENCH = board.ROOT / "tools" / "target" / "core_bench.cpp"
QUIET = ["-Wno-fatal", "-Wno-lint", "-Wno-style", "-Wno-BLKANDNBLK"]  # the package's own


def sources():
    """The files of the core with its FPU, by the list that comes with it."""
    where = board.run(
        [board.PYTHON, "-c", f"import {PACKAGE} as p; print(p.data_location)"]
    ).strip()
    text = (Path(where) / "cv32e40p_fpu_manifest.flist").read_text(encoding="utf-8")
    text = re.sub(r"^.*(?:tb_wrapper|tracer_pkg).*\n", "", text, flags=re.MULTILINE)
    return text.replace("${DESIGN_RTL_DIR}", f"{where}/rtl")


def bench():
    """The simulator's program; made once."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    program, stamp = FOLDER / "made" / "core_bench", FOLDER / "made_from"
    listed, made_from = sources(), BENCH.read_text(encoding="utf-8")
    if program.is_file() and stamp.is_file() and stamp.read_text() == listed + made_from:
        return program
    (FOLDER / "core.f").write_text(listed, encoding="utf-8")
    options = ["--cc", "--exe", "--build", "-j", "2", "-O3", "-CFLAGS", "-O2 -std=c++17", *QUIET]
    options += ["--top-module", "cv32e40p_top", "-GFPU=1", "--Mdir", FOLDER / "made"]
    board.run(["verilator", *options, "-f", FOLDER / "core.f", BENCH, "-o", "core_bench"])
    stamp.write_text(listed + made_from, encoding="utf-8")
    return program


def count(build, pc, streams):
    """The steps of all streams, each with its cycles and instructions."""
    with tempfile.TemporaryDirectory() as folder:
        counts, replies = play(build, Path(folder), streams)
    with tempfile.TemporaryDirectory() as folder:
        expected = board.replay(pc.command("belt_server"), Path(folder), b"".join(streams))
    if replies != expected:
        raise board.Failure("the core computes other bits than the PC")
    return list(counting.steps(streams, replies, counts))


def play(build, folder, streams):
    """Cycles and instructions of each step, and the replies."""
    image = folder / "core.bin"
    board.run([machine.tool(build, "objcopy"), "-O", "binary", build.folder / "belt_core", image])
    (folder / "core_requests").write_bytes(b"".join(streams))
    files = [folder / name for name in ("core_requests", "core_replies", "core_counts")]
    board.run([bench(), image, *files])
    numbers = files[2].read_bytes()
    pairs = list(struct.iter_unpack("<2I", numbers))
    nothing = pairs[0]  # what the counting itself takes
    counts = [(cycles - nothing[0], done - nothing[1]) for cycles, done in pairs[1:]]
    return counts, files[1].read_bytes()
