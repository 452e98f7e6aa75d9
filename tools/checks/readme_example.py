# SPDX-License-Identifier: MIT
"""The C example of README.md compiles with the project's warnings and runs to exit status 0.

It is the first ```c block that has the line /* readme_example */. The compiler and its options
follow after --.
"""

import re
import subprocess
from pathlib import Path

import tree

BLOCK = re.compile(r"^```c[ \t]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
MARK = "/* readme_example */"


def example(readme: Path) -> str | None:
    if not readme.is_file():
        return None
    blocks = BLOCK.findall(readme.read_text(encoding="utf-8"))
    return next((block for block in blocks if MARK in map(str.strip, block.splitlines())), None)


def main(argv: list[str]) -> int:
    parser = tree.arguments(__doc__)
    parser.add_argument("--library", type=Path, required=True)
    parser.add_argument("--work-dir", type=Path, required=True)
    parser.add_argument("compiler", nargs="+")
    given = parser.parse_args(argv)

    code = example(given.root / "README.md")
    if code is None:
        return tree.report([f"README.md: no ```c block with the line {MARK}"], 1)
    source = given.work_dir / "readme_example.c"
    program = source.with_suffix("")
    source.write_text(code, encoding="utf-8")
    compiled = subprocess.run([*given.compiler, source, given.library, "-o", program])
    if compiled.returncode != 0:
        return tree.report(["README.md: the example does not compile"], 1)
    status = subprocess.run([program]).returncode
    return tree.report([f"README.md: the example exits with {status}"] if status else [], 1)


if __name__ == "__main__":
    tree.run(main)
