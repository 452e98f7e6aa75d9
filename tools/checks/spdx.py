# SPDX-License-Identifier: MIT
"""Every source and script says under which licence it stands, near its top."""

from itertools import islice
from pathlib import Path

import tree

LINES = 5


def wants_licence(path: Path) -> bool:
    return (
        tree.is_c(path)
        or tree.is_python(path)
        or tree.is_shell(path)
        or path.suffix == ".cmake"
        or path.name == "CMakeLists.txt"
    )


def says_licence(path: Path) -> bool:
    with path.open(encoding="utf-8") as file:
        return any("SPDX-License-Identifier: MIT" in line for line in islice(file, LINES))


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    paths = [path for path in tree.files(root) if wants_licence(path)]
    bare = [path for path in paths if not says_licence(path)]
    return tree.report(
        [f"{path.relative_to(root)}: no SPDX-License-Identifier: MIT" for path in bare], len(paths)
    )


if __name__ == "__main__":
    tree.run(main)
