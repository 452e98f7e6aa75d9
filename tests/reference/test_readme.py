# SPDX-License-Identifier: MIT
"""What reference/README.md names is there, and its example runs."""

import re
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parent
README = (HERE.parents[1] / "reference" / "README.md").read_text(encoding="utf-8")
MODULES = [path.stem for path in (HERE.parents[1] / "reference").glob("*.py")]


def rows():
    """The function cells of the tables from equation to function."""
    for line in README.splitlines():
        cells = line.strip("| ").split(" | ")
        if line.startswith("|") and len(cells) == 3:
            yield cells[-1]


def names():
    """Every dotted name of those cells; `.name` stands beside the one before it."""
    for cell in rows():
        owner = None
        for name in re.findall(r"`([^`]+)`", cell):
            if name.startswith("."):
                yield f"{owner}{name}"
            elif name.split(".")[0] in MODULES:
                owner = name.rpartition(".")[0]
                yield name


def test_functions_named_exist():
    found = sorted(set(names()))
    assert len(found) > 60
    for name in found:
        module, *rest = name.split(".")
        value = import_module(f"reference.{module}")
        for part in rest:
            # an attribute made in __init__ is found in the source of its class
            known = (
                hasattr(value, part) or f"self.{part} =" in Path(module_file(module)).read_text()
            )
            assert known, name
            value = getattr(value, part, None)


def module_file(module):
    return import_module(f"reference.{module}").__file__


def test_tests_named_exist():
    sources = "".join(path.read_text(encoding="utf-8") for path in HERE.glob("test_*.py"))
    named = set(re.findall(r"`(test_\w+)`", README)) - {"test_section4"}
    assert len(named) > 20
    assert [name for name in named if f"def {name}(" not in sources] == []


def test_example_of_the_readme_runs():
    (source,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    scope = {}
    exec(source.replace("duration=4.0", "duration=4.0, node_count=20"), scope)  # noqa: S102
    assert np.max(np.abs(scope["trace"].state[:, -1])) == pytest.approx(0.0, abs=0.05)
