# SPDX-License-Identifier: MIT
"""An emulated Cortex-M4F computes the same bits, and tools/pil would notice if it did not."""

import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PARTS = ROOT / "tools" / "target"


def pil(*arguments):
    return subprocess.run(
        [sys.executable, ROOT / "tools" / "pil", "--no-build", *arguments],
        capture_output=True,
        text=True,
    )


def shipped():
    return sorted(path.stem for path in (ROOT / "host_sim" / "scenarios").glob("*.ini"))


@pytest.mark.parametrize("target", ["cortex-m4f", "host"])
def test_every_shipped_scenario_is_the_same_to_the_bit(target):
    found = pil("--target", target)
    assert found.returncode == 0, found.stdout + found.stderr
    lines = found.stdout.splitlines()
    assert sorted(line.split()[1] for line in lines) == shipped()
    assert all(line.endswith("the same bits") for line in lines)


def server_of(folder, change):
    """A server on the PC from changed sources; the command that runs it."""
    firmware = folder / "belt"
    firmware.mkdir()
    for path in (ROOT / "firmware" / "belt").glob("*.[ch]"):
        (firmware / path.name).write_text(change(path.name, path.read_text()))
    parts = [PARTS / name for name in ("server.c", "exchange.c", "channel.c", "channel_posix.c")]
    capacities = ["-DBELT_NODE_CAPACITY=320", "-DBELT_WINDOW_CAPACITY=8192"]
    capacities += ["-DBELT_LOSS_CAPACITY=64"]
    server = folder / "server"
    subprocess.run(
        ["cc", "-std=c99", "-O1", "-ffp-contract=off", *capacities, f"-I{folder}", f"-I{PARTS}"]
        + ["-o", server, *parts, *firmware.glob("*.c")],
        check=True,
    )
    return shlex.quote(str(server))


def test_bridge_that_computes_the_same_passes(tmp_path):
    server = server_of(tmp_path, lambda name, text: text)
    found = pil("paper", "--bridge", server)
    assert found.returncode == 0, found.stdout + found.stderr


def test_last_bit_of_one_number_is_noticed(tmp_path):
    def change(name, text):
        half = "#define BELT_HALF BELT_REAL(0.5)"
        assert name != "types.h" or half in text
        return text.replace(half, "#define BELT_HALF BELT_REAL(0.50000006)")

    found = pil("paper", "--bridge", server_of(tmp_path, change))
    assert found.returncode == 1, found.stdout + found.stderr
    assert "on the PC" in found.stdout and "on the board" in found.stdout


def test_board_that_falls_silent_fails(tmp_path):
    found = pil("paper", "--bridge", "false")
    assert found.returncode == 1
    assert "exit code" in found.stdout


def test_unknown_scenario_is_bad_input():
    found = pil("no_such_scenario", "--target", "host")
    assert found.returncode == 2
    assert "no_such_scenario" in found.stderr


def test_periodic_task_keeps_its_period_and_the_bits():
    found = pil("paper", "--target", "cortex-m4f", "--periodic")
    assert found.returncode == 0, found.stdout + found.stderr
    assert "the same bits" in found.stdout
    assert " 0 overruns, 0 periods lost; watchdog fed 4001 times" in found.stdout


def test_periodic_task_counts_what_it_misses():
    found = pil("paper", "--target", "cortex-m4f", "--periodic", "--period", "0.0002")
    assert found.returncode == 0, found.stdout + found.stderr
    assert "periods were lost" in found.stdout
    assert " 0 overruns" not in found.stdout


def test_watchdog_resets_the_board_when_a_step_hangs():
    found = pil("paper", "--target", "cortex-m4f", "--periodic", "--hang", "100")
    assert found.returncode == 0, found.stdout + found.stderr
    assert "fed 100 times, the watchdog has reset the board" in found.stdout


def test_task_that_never_hangs_is_not_reset():
    found = pil("paper", "--target", "cortex-m4f", "--periodic", "--hang", "1000000")
    assert found.returncode == 2
    assert "exit code 0" in found.stderr


@pytest.mark.parametrize("optimization", ["O0", "Os", "O3"])
def test_optimization_changes_no_bit(optimization):
    words = [sys.executable, ROOT / "tools" / "pil", "paper", "lossy_profile"]
    found = subprocess.run(
        [*words, "--target", "cortex-m4f", "--optimization", optimization],
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr
    assert found.stdout.count("the same bits") == 2
