# SPDX-License-Identifier: MIT
"""MISRA C:2012, as far as cppcheck's addon checks it, holds in the firmware.

What deviates is listed with its reason in misra_deviations.txt.

The addon names rules by their numbers: their texts are not free.
"""

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import deviations
import tree

FINDING = re.compile(r"^(.+?):(\d+): misra-c2012-([\d.]+)$", re.MULTILINE)
OPTIONS = [
    "--quiet",
    "--std=c99",
    "--addon=misra",
    "-UBELT_LINE_LAWS",
    "--suppress=missingIncludeSystem",
    "--template={file}:{line}: {id}",
]


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    paths = [path for path in tree.files(root, "firmware/belt") if path.suffix == ".c"]
    findings = set()
    faults = []
    if paths:
        names = [path.relative_to(root).as_posix() for path in paths]
        # In a copy: the addon keeps notes on the whole program beside the sources, where another
        # cppcheck at work on them takes them away.
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(root / "firmware", Path(folder, "firmware"))
            result = subprocess.run(
                ["cppcheck", *OPTIONS, "-I", "firmware", *names],
                cwd=folder,
                capture_output=True,
                text=True,
            )
        if result.returncode != 0:
            faults.append(result.stderr.strip() or result.stdout.strip())
        for path, line, rule in FINDING.findall(result.stderr):
            text = (root / path).read_text(encoding="utf-8").splitlines()[int(line) - 1].strip()
            findings.add(deviations.Finding((rule,), path, int(line), text))
    ordered = sorted(findings, key=lambda finding: (finding.path, finding.line, finding.rules))
    faults += deviations.violations(root, "misra", ordered)
    return tree.report(faults, len(paths))


if __name__ == "__main__":
    tree.run(main)
