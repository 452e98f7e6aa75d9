# SPDX-License-Identifier: MIT
"""How C, Python and scripts are written: clang-format, ruff and shellcheck find nothing.

With --fix the first two rewrite what they can.
"""

import subprocess
import sys
from pathlib import Path

import tree

HERE = Path(sys.executable).parent  # clang-format and ruff of the versions of requirements.txt


def passes(command: list, paths: list[Path], root: Path) -> bool:
    if not paths:
        return True
    return subprocess.run([*map(str, command), *map(str, paths)], cwd=root).returncode == 0


def main(argv: list[str]) -> int:
    parser = tree.arguments(__doc__)
    parser.add_argument("--fix", action="store_true", help="rewrite instead of complaining")
    given = parser.parse_args(argv)
    root = given.root
    paths = list(tree.files(root))
    c = [path for path in paths if tree.is_c(path)]
    python = [path for path in paths if tree.is_python(path)]
    shell = [path for path in paths if tree.is_shell(path)]

    config = ["--config", root / "pyproject.toml"]
    clang_format = [HERE / "clang-format", f"--style=file:{root / '.clang-format'}"]
    if given.fix:
        tools = [
            ([*clang_format, "-i"], c),
            ([HERE / "ruff", "check", "--quiet", "--fix", *config], python),
            ([HERE / "ruff", "format", "--quiet", *config], python),
        ]
    else:
        tools = [
            ([*clang_format, "--dry-run", "--Werror"], c),
            ([HERE / "ruff", "check", "--quiet", *config], python),
            ([HERE / "ruff", "format", "--quiet", "--check", "--diff", *config], python),
        ]
    tools.append((["shellcheck"], shell))

    violations = [
        f"{Path(command[0]).name} {command[1]}: see above"
        for command, paths in tools
        if not passes(command, paths, root)
    ]
    return tree.report(violations, len(c) + len(python) + len(shell))


if __name__ == "__main__":
    tree.run(main)
