# SPDX-License-Identifier: MIT
"""tools/figures draws the same bytes of the same traces, and says where they are."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.system.command import belt_sim

TOOL = Path(__file__).resolve().parents[2] / "tools" / "figures"
NAMES = ["level", "density_paper", "density_heavy_window", "survival"]


def draw(source, folder, cache):
    environment = {**os.environ, "MPLCONFIGDIR": str(cache)}
    command = [sys.executable, TOOL, source, folder]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, env=environment)


@pytest.fixture(scope="module")
def traces(tmp_path_factory):
    """Runs of 1 s of the eight that tools/demo makes."""
    folder = tmp_path_factory.mktemp("traces")
    for scenario in ("paper", "heavy_window"):
        for law in ("predictor", "frozen", "uncompensated", "open_loop"):
            name = folder / f"{scenario}_{law}"
            outputs = ("--trace", f"{name}.csv", "--density", f"{name}_density.csv")
            settings = ("--set", "run.duration=1", "--set", f"controller.law={law}")
            assert belt_sim("run", scenario, *settings, *outputs).returncode == 0
    return folder


def test_figures_are_drawn_the_same_each_time_and_only_their_paths_printed(traces, tmp_path):
    contents = []
    for folder in (tmp_path / "one", tmp_path / "two"):
        result = draw(traces, folder, tmp_path / "cache")
        assert result.returncode == 0, result.stderr
        expected = [folder / f"{name}.{suffix}" for name in NAMES for suffix in ("png", "svg")]
        assert result.stdout.splitlines() == list(map(str, expected))
        contents.append([path.read_bytes() for path in expected])
    assert contents[0] == contents[1]
    assert all(content[:4] == b"\x89PNG" for content in contents[0][::2])


def test_missing_trace_is_said_and_fails(tmp_path):
    result = draw(tmp_path, tmp_path / "figures", tmp_path / "cache")
    assert result.returncode != 0
    assert result.stdout == "" and "paper_predictor.csv" in result.stderr
