# SPDX-License-Identifier: MIT
"""Error against cost for node_count 5 to 160: the greatest difference between the level and the
exact solution (the shift theorem), and the instructions of a step on a Cortex-M4F."""

import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "tools" / "target")]
import board  # noqa: E402
import counting  # noqa: E402
import inputs  # noqa: E402

from reference.line import Law, Line  # noqa: E402
from reference.shift_theorem import level_of  # noqa: E402

NODE_COUNTS = [5, 10, 20, 40, 80, 160]
LINES = {
    "paper": Line(),
    "heavy_window": Line(speed_window=3.0),
    "lossy_profile": Line(loss_rate=(0.4, 1.2, 2.0, 1.0, 0.5)),
}


def error(pc, scenario, line, node_count):
    """The greatest difference, or None where a rule asks for more nodes."""
    with tempfile.TemporaryDirectory() as folder:
        trace = Path(folder) / "trace.csv"
        nodes = ["--set", f"controller.node_count={node_count}"]
        command = [pc.folder / "belt_sim", "run", scenario, *nodes, "--trace", trace]
        try:
            board.run(command)
        except board.Failure as failure:
            if "raise node_count" in str(failure):
                return None
            raise
        rows = np.genfromtxt(trace, delimiter=",", names=True)
    return float(np.max(np.abs(rows["buffer_level"] - level_of(line, Law(), rows["time"]))))


def instructions(pc, node_count):
    """The greatest count of a step in the run `paper`, but for the first."""
    build = board.build("cortex-m4f", defines=[("BELT_NODE_CAPACITY", str(node_count))])
    stream = inputs.record(pc, "paper", "--set", f"controller.node_count={node_count}")
    steps = counting.count(build, pc.folder / "count_plugin.so", [stream])
    return max(step.instructions for step in steps if step.is_good_automatic())


def main():
    pc = board.build(
        "host", programs=["belt_sim", "belt_sim_remote", "belt_server", "count_plugin"]
    )
    print(f"| nodes | instructions, `paper` | {' | '.join(f'error, `{name}`' for name in LINES)} |")
    print(f"|{' --- |' * (len(LINES) + 2)}")
    for node_count in NODE_COUNTS:
        errors = [error(pc, name, line, node_count) for name, line in LINES.items()]
        cells = ["refused" if value is None else f"{value:.1e}" for value in errors]
        print(
            f"| {node_count} | {instructions(pc, node_count)} | {' | '.join(cells)} |", flush=True
        )


if __name__ == "__main__":
    try:
        main()
    except board.Failure as failure:
        sys.exit(f"curve: {failure}")
