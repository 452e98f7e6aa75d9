# SPDX-License-Identifier: MIT
"""What all figures of tools/figures share: how they look, and how traces are read."""

import csv

import matplotlib.pyplot as plt
import numpy as np

SCENARIOS = {
    "paper": "paper: speed follows the last 0.2 s",
    "heavy_window": "heavy_window: speed follows the last 3 s",
}
# Colours of Okabe and Ito, told apart by the colour-blind; the dashes tell them apart in grey.
LAWS = {
    "predictor": ("predictor", "#0072B2", "-", 2.0),
    "frozen": ("dead time frozen", "#D55E00", (0, (5, 1.5)), 1.5),
    "uncompensated": ("uncompensated", "#009E73", (0, (6, 1.5, 1.2, 1.5)), 1.4),
    "open_loop": ("open loop", "#000000", (0, (1.2, 1.3)), 1.4),
}
PALETTE = "viridis"  # even steps of lightness, told apart by the colour-blind
STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.5,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.w_pad": 0.08,
    "savefig.dpi": 150,
    "svg.hashsalt": "forebelt",
}


def read(path):
    """A trace: an array for each column."""
    with path.open(encoding="utf-8") as file:
        names = next(csv.reader(file))
    values = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    return dict(zip(names, values.T, strict=True))


def read_density(path):
    """Times [s], places [m], densities [parts/m] with a row for each time."""
    columns = read(path)
    times = columns.pop("time")
    return times, np.array([float(name) for name in columns]), np.array([*columns.values()]).T


def save(figure, folder, name):
    for suffix, metadata in (("png", {"Software": None}), ("svg", {"Date": None})):
        path = folder / f"{name}.{suffix}"
        figure.savefig(path, metadata=metadata)
        print(path)
    plt.close(figure)


def edges(centres):
    """Where the picture of equally spaced values begins and ends."""
    half = 0.5 * (centres[1] - centres[0])
    return centres[0] - half, centres[-1] + half
