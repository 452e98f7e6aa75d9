# SPDX-License-Identifier: MIT
"""What the checks share: the files to look at, C without its comments, and how to report."""

import argparse
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path

NOT_OURS = {"build", ".git", "__pycache__", ".hypothesis"}

COMMENT_OR_LITERAL = re.compile(
    r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'""", re.DOTALL
)


def arguments(description: str) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--root", type=Path, required=True, help="the project's root")
    return parser


def files(root: Path, *folders: str) -> Iterator[Path]:
    """Every file of ours below the folders (or the whole tree), in a fixed order."""
    for top in [root / folder for folder in folders] or [root]:
        for folder, inner, names in os.walk(top):
            inner[:] = sorted(name for name in inner if name not in NOT_OURS)
            yield from (Path(folder, name) for name in sorted(names))


def is_c(path: Path) -> bool:
    return path.suffix in {".c", ".h"}


def first_line(path: Path) -> str:
    with path.open("rb") as file:
        return file.readline(200).decode("utf-8", "replace")


def is_python(path: Path) -> bool:
    line = "" if path.suffix else first_line(path)
    return path.suffix == ".py" or (line.startswith("#!") and "python" in line)


def is_shell(path: Path) -> bool:
    line = "" if path.suffix else first_line(path)
    return path.suffix == ".sh" or bool(re.match(r"#!.*\b(ba|da)?sh\b", line))


def without_comments(text: str, keep_strings: bool = False) -> str:
    """C text with comments (and strings) blanked out; every line keeps its number."""

    def blank(match: re.Match[str]) -> str:
        if keep_strings and match[0][0] == '"':
            return match[0]
        return re.sub(r"[^\n]", " ", match[0])

    return COMMENT_OR_LITERAL.sub(blank, text)


def report(violations: list[str], looked_at: int) -> int:
    """The exit status. A check that looked at nothing has not passed."""
    for violation in violations:
        print(violation)
    if looked_at == 0:
        print("nothing to look at: this check found no file of its kind")
        return 1
    if not violations:
        print(f"{looked_at} looked at, no violation")
    return 1 if violations else 0


def run(main) -> None:
    sys.exit(main(sys.argv[1:]))
