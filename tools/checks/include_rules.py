# SPDX-License-Identifier: MIT
"""Who may know whom: the direction of dependency, read from the includes and imports."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import tree

# Each of these may include those before it.
FOUNDATION = [
    "types",
    "line_laws",
    "status",
    "exponential",
    "integrity",
    "modes",
    "config",
    "limits",
    "line_model",
]
# The block diagram, left to right: a stage may include the foundation and what stands left of it.
STAGES = [
    "measurement",
    "level_history",
    "observer",
    "estimator",
    "internal_model",
    "fast_forward",
    "carried_transfer",
    "prediction",
    "march_step",
    "march_stretch",
    "march_pairs",
    "predictor",
    "nominal_law",
    "command",
    "supervisor",
]
USES_GAINS = {"nominal_law", "command"}
# The one header that a build names on each side: another line's laws.
NAMED_BY_THE_BUILD = (("line_laws", "BELT_LINE_LAWS"), ("line_laws", "SIM_LINE_LAWS"))
FIRMWARE_STANDARD = {"stddef.h", "stdint.h", "stdbool.h", "float.h", "string.h", "limits.h"}

# Those who speak with the controller on the scenario's behalf; only they may include each other.
SPEAKS_WITH_THE_CONTROLLER = ("model", "operator", "power", "promises", "reception", "rivals")
SEES_THE_CONTROLLER = {"loop.c", "check.c"} | {
    part + end for part in SPEAKS_WITH_THE_CONTROLLER for end in (".c", ".h")
}
DOORS = ("belt/belt.h", "belt/safety.h", "belt/snapshot.h")
SEES_BOTH_SIDES = "loop.c"

REFERENCE_PACKAGES = {"numpy", "scipy", "matplotlib", "reference"}
REFERENCE_REFUSED = {"ctypes", "cffi", "subprocess"}  # C and Python meet only in files

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include\b[ \t]*(?:"([^"]*)"|<([^>]*)>|(\S+))', re.MULTILINE)


def allowed_parts() -> dict[str, set[str]]:
    """For each part of the firmware the parts that it may include; itself always."""
    allowed = {}
    for index, part in enumerate(FOUNDATION):
        allowed[part] = set(FOUNDATION[:index])
    allowed["gains"] = set(FOUNDATION)
    for index, part in enumerate(STAGES):
        allowed[part] = {*FOUNDATION, *STAGES[:index]}
        if part in USES_GAINS:
            allowed[part].add("gains")
    allowed["belt"] = {*FOUNDATION, "gains", *STAGES}
    for part in ("snapshot", "safety"):
        allowed[part] = {*allowed["belt"], "belt"}
    return allowed


def includes(path: Path) -> Iterator[tuple[int, str, bool]]:
    """Line, what is included, and whether in angle brackets."""
    text = tree.without_comments(path.read_text(encoding="utf-8"), keep_strings=True)
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start()) + 1
        quoted, angled, computed = match.groups()
        yield line, quoted or angled or computed, angled is not None


def firmware(root: Path, path: Path) -> Iterator[str]:
    allowed = allowed_parts()
    where = path.relative_to(root)
    if path.stem not in allowed:
        yield f"{where}: has no place in the order; give it one in {Path(__file__).name}"
        return
    for line, name, angled in includes(path):
        part = name.removeprefix("belt/").removesuffix(".h")
        if angled:
            if name not in FIRMWARE_STANDARD:
                yield f"{where}:{line}: <{name}> is not among the standard headers of the firmware"
        elif part not in allowed:
            if (path.stem, part) not in NAMED_BY_THE_BUILD:
                yield f"{where}:{line}: {name} is no header of the firmware"
        elif part != path.stem and part not in allowed[path.stem]:
            yield f"{where}:{line}: {path.stem} may not know {part}"


def host_sim(root: Path, path: Path) -> Iterator[str]:
    where = path.relative_to(root)
    for line, name, angled in includes(path):
        sees_the_controller = path.name in SEES_THE_CONTROLLER
        if name in DOORS or name in SEES_THE_CONTROLLER:
            if not sees_the_controller:
                seers = ", ".join(sorted(SEES_THE_CONTROLLER))
                yield f"{where}:{line}: {name}: only {seers} see the controller"
        elif name == "plant.h" and sees_the_controller and path.name != SEES_BOTH_SIDES:
            yield f"{where}:{line}: only {SEES_BOTH_SIDES} sees both plant and controller"
        elif name.startswith("belt/") or "firmware" in name:
            yield f"{where}:{line}: {name}: no door to the controller; those are {', '.join(DOORS)}"
        elif (path.stem, name) in NAMED_BY_THE_BUILD:
            continue
        elif not angled and not (root / "host_sim" / name).is_file():
            yield f"{where}:{line}: {name} is not a header of host_sim"


def reference(root: Path, path: Path) -> Iterator[str]:
    where = path.relative_to(root)
    ours = {other.stem for other in (root / "reference").rglob("*.py")}
    allowed = (set(sys.stdlib_module_names) | REFERENCE_PACKAGES | ours) - REFERENCE_REFUSED
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            depth = len(path.parent.relative_to(root).parts)
            names = [node.module or ""] if node.level == 0 else []
            if node.level > depth:
                yield f"{where}:{node.lineno}: imports from outside reference/"
        else:
            continue
        for name in names:
            if name.split(".")[0] not in allowed:
                yield f"{where}:{node.lineno}: {name} is neither numpy, scipy nor of reference/"


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    violations: list[str] = []
    looked_at = 0
    for folder, is_kind, rule in (
        ("firmware/belt", tree.is_c, firmware),
        ("host_sim", tree.is_c, host_sim),
        ("reference", tree.is_python, reference),
    ):
        paths = [path for path in tree.files(root, folder) if is_kind(path)]
        looked_at += len(paths)
        if not paths:
            violations.append(f"{folder}: no file of its kind there")
        for path in paths:
            violations.extend(rule(root, path))
    return tree.report(violations, looked_at)


if __name__ == "__main__":
    tree.run(main)
