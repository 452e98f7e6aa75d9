# SPDX-License-Identifier: MIT
"""clang-tidy finds nothing in the firmware and the simulator but what is listed with its reason.

Which checks are on, and why others are not, stands in .clang-tidy; single places that stay, in
clang_tidy_deviations.txt.
"""

import re
import subprocess

import deviations
import tree

FINDING = re.compile(r"^(.+?):(\d+):\d+: (?:warning|error): (.*) \[([\w.,+-]+)\]$", re.MULTILINE)
OPTIONS = ["-std=c99", "-Ifirmware", "-Ihost_sim", '-DBELT_SIM_SCENARIO_DIR="scenarios"']


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root.resolve()
    paths = [path for path in tree.files(root, "firmware/belt", "host_sim") if path.suffix == ".c"]
    findings = set()
    faults = []
    if paths:
        command = ["clang-tidy-19", "--quiet", f"--config-file={root / '.clang-tidy'}"]
        result = subprocess.run(
            [*command, *map(str, paths), "--", *OPTIONS], cwd=root, capture_output=True, text=True
        )
        for path, line, text, rules in FINDING.findall(result.stdout):
            where = (root / path).resolve()
            where = where.relative_to(root) if where.is_relative_to(root) else where
            findings.add(
                deviations.Finding(tuple(rules.split(",")), where.as_posix(), int(line), text)
            )
        if result.returncode != 0 and not findings:
            faults.append(result.stderr.strip() or f"clang-tidy: exit code {result.returncode}")
    ordered = sorted(findings, key=lambda finding: (finding.path, finding.line, finding.rules))
    faults += deviations.violations(root, "clang_tidy", ordered)
    return tree.report(faults, len(paths))


if __name__ == "__main__":
    tree.run(main)
