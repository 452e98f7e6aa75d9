# SPDX-License-Identifier: MIT
"""The library keeps no state of its own: .data, .bss and common symbols of its objects are 0 bytes.

Constant tables of addresses (.data.rel.ro) are not state.
"""

import re
import subprocess
from pathlib import Path

import tree

STATE = re.compile(r"^\.(?:data(?!\.rel\.ro)|bss|tdata|tbss|sdata|sbss)(?:\.|$)")
COMMON = "*COM*"


def main(argv: list[str]) -> int:
    parser = tree.arguments(__doc__)
    parser.add_argument("--library", type=Path, required=True)
    library = parser.parse_args(argv).library

    def output(*command: str) -> list[str]:
        whole = subprocess.run([*command, library], check=True, capture_output=True, text=True)
        return whole.stdout.splitlines()

    violations = []
    member = ""
    members = 0
    for line in output("size", "-A"):
        words = line.split()
        if len(words) > 1 and words[1] == "(ex":
            member = words[0]
            members += 1
        elif len(words) == 3 and STATE.match(words[0]) and int(words[1]) > 0:
            violations.append(f"{member}: {words[1]} bytes in {words[0]}")
    violations.extend(
        f"common symbol: {line}" for line in output("objdump", "-t") if COMMON in line
    )
    return tree.report(violations, members)


if __name__ == "__main__":
    tree.run(main)
