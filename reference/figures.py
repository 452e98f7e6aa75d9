# SPDX-License-Identifier: MIT
"""python -m reference.figures FOLDER [NAME]: what the theorems promise and what happens.

  norm_equivalence.png  Lemmas 11 and 12 on a worked system: sup norms of 400 random belts against
                        the K-infinity bounds of the proofs
  safety.png            Proposition 2: up to which rework rate the flux stays positive, by the
                        proposition, by the sharper bound, and in simulation

Needs matplotlib besides numpy and scipy.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from reference import equilibrium
from reference.examples.nonlinear_recycle import CONSTANTS, EXAMPLE
from reference.integral_equations import Nodes, forward, inverse
from reference.line import Law, Line
from reference.mixed_loop import simulate
from reference.record import Record
from reference.safety import State, proposition_2, sharper
from reference.section4 import conveyor

BOUND, SEEN, SAFE = "#b03a2e", "#1f618d", "#1e8449"


def norms(count: int = 400):
    """(sizes, sup |w| of u, sup |u| of w) on random belts; each (count,).

    A size is |X| + sup |u|, or |X| + sup |w|, shared out at random.
    """
    random = np.random.default_rng(2)
    system = EXAMPLE.system
    nodes = Nodes(np.linspace(0.0, system.belt_length, 61))
    sizes = 10.0 ** random.uniform(-3.0, 2.0, count)
    answers = []
    for size in sizes:
        share, state = random.random(), 0.0
        values = np.cumsum(random.normal(size=len(nodes))) + random.normal()
        values *= share * size / np.max(np.abs(values))
        state = (1.0 - share) * size * random.choice([-1.0, 1.0])
        record = Record.of(system.speed_window, np.array([state]), 50)
        both = forward(system, nodes, values, record), inverse(system, nodes, values, record)
        answers.append([np.max(np.abs(part)) for part in both])
    return sizes, *np.array(answers).T


def threshold(holds: Callable[[float], bool], low: float = 1e-3, high: float = 30.0) -> float:
    """The rework rate up to which `holds`, by bisection, within 2 %."""
    while high / low > 1.02:
        middle = np.sqrt(low * high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return float(low)


def stays_positive(line: Line, law: Law) -> bool:
    """Whether U > 0 in the closed loop from the empty line, over five transits."""
    crowded = 1.0 + law.level_setpoint * line.speed_window
    duration = 5.0 * line.processing_time * line.belt_length * crowded
    trace = simulate(conveyor(line, law), np.array([0.0]), 0.0, duration, 20)
    return bool(np.min(trace.control) > 0.0)


def draw_norms(path: Path) -> None:
    import matplotlib.pyplot as plt

    sizes, targets, values = norms()
    order = np.geomspace(1e-3, 1e2, 100)
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.2), sharey=True, layout="constrained")
    panels = (
        (targets, CONSTANTS.transformation_bound, "|X| + sup|u|", "sup|w|", "K3, Lemma 11"),
        (values, CONSTANTS.inverse_bound, "|X| + sup|w|", "sup|u|", "K4, Lemma 12"),
    )
    for axis, (seen, bound, abscissa, ordinate, label) in zip(axes, panels, strict=True):
        axis.loglog(order, bound(order, order), color=BOUND, label=label)
        axis.loglog(sizes, seen, ".", color=SEEN, markersize=3, label="random belts")
        axis.set(xlabel=abscissa, title=f"{ordinate} against its bound")
        axis.legend(frameon=False)
        axis.grid(alpha=0.2)
    figure.savefig(path, dpi=120)
    plt.close(figure)


def draw_safety(path: Path) -> None:
    import matplotlib.pyplot as plt

    law = Law()
    windows = np.geomspace(0.05, 5.0, 9)
    curves: dict[str, list[float]] = {}
    for window in windows:

        def line(rework_rate: float, window: float = window) -> Line:
            return Line(speed_window=window, rework_rate=rework_rate)

        def promised(bound, rework_rate, line=line) -> bool:
            return bound(line(rework_rate), law, State.held(line(rework_rate), 0.0)).holds

        rates = {
            "at rest (necessary)": threshold(
                lambda rate: equilibrium.inlet_flux(line(rate), law.level_setpoint) > 0.0
            ),
            "simulation": threshold(lambda rate: stays_positive(line(rate), law)),
            "sharper bound": threshold(lambda rate: promised(sharper, rate)),
            "Proposition 2, derived": threshold(lambda rate: promised(proposition_2, rate)),
        }
        for name, rate in rates.items():
            curves.setdefault(name, []).append(rate)
    figure, axis = plt.subplots(figsize=(7, 4.5), layout="constrained")
    styles = zip(curves.items(), (":", "-", "-", "-"), ("k", SEEN, SAFE, BOUND), strict=True)
    for (name, rates), style, colour in styles:
        axis.loglog(windows, rates, linestyle=style, color=colour, label=name, marker=".")
    axis.axhline(Line().rework_rate, color="0.7", linewidth=0.8)
    axis.annotate("the paper's A", (windows[0], Line().rework_rate), va="bottom", color="0.5")
    axis.set(xlabel="speed_window [s]", ylabel="rework_rate A up to which U > 0 [1/(m s)]")
    axis.legend(frameon=False)
    axis.grid(alpha=0.2)
    figure.savefig(path, dpi=120)
    plt.close(figure)


FIGURES = {"norm_equivalence": draw_norms, "safety": draw_safety}


def main(arguments: list[str]) -> int:
    """Draw the named picture, or all, into the folder; returns the exit code."""
    if not arguments or not set(arguments[1:]) <= set(FIGURES):
        print(f"usage: python -m reference.figures FOLDER [{'|'.join(FIGURES)}]", file=sys.stderr)
        return 2
    import matplotlib

    matplotlib.use("Agg")
    folder = Path(arguments[0])
    folder.mkdir(parents=True, exist_ok=True)
    for name in arguments[1:] or FIGURES:
        FIGURES[name](folder / f"{name}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
