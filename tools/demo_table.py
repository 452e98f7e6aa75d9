# SPDX-License-Identifier: MIT
"""Prints the table of tools/demo from the summaries of its runs."""

import argparse
import json
from pathlib import Path

COLUMNS = [
    "scenario",
    "law",
    "settling to 2 %",
    "overshoot",
    "IAE",
    "greatest flux",
    "final error",
]


def cells(scenario: str, law: str, summary: dict) -> list[str]:
    settling = summary["settling_time"]
    return [
        scenario,
        law,
        "never" if settling is None else f"{settling:.3f} s",
        f"{100 * summary['overshoot']:.2f} %",
        f"{summary['iae']:.4f} parts s",
        f"{summary['inlet_flux_peak']:.3f} parts/s",
        f"{summary['final_error']:+.2e} parts",
    ]


def table(rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    left = 2  # names to the left, numbers to the right
    lines = [
        "  ".join(
            cell.ljust(width) if index < left else cell.rjust(width)
            for index, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in rows
    ]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, help="where SCENARIO_LAW.json lie")
    parser.add_argument("--scenarios", nargs="+", required=True)
    parser.add_argument("--laws", nargs="+", required=True)
    given = parser.parse_args()
    rows = [COLUMNS]
    for scenario in given.scenarios:
        for law in given.laws:
            path = given.folder / f"{scenario}_{law}.json"
            rows.append(cells(scenario, law, json.loads(path.read_text(encoding="utf-8"))))
    print(table(rows))


if __name__ == "__main__":
    main()
