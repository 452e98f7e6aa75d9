# SPDX-License-Identifier: MIT
"""gcc's static analyzer (-fanalyzer) finds nothing in the firmware and the simulator."""

import subprocess

import tree

OPTIONS = ["-std=c99", "-Og", "-fanalyzer", "-Werror", "-Ifirmware", "-Ihost_sim"]
DEFINITIONS = ['-DBELT_SIM_SCENARIO_DIR="scenarios"']


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    paths = [path for path in tree.files(root, "firmware/belt", "host_sim") if path.suffix == ".c"]
    violations = []
    for path in paths:
        name = str(path.relative_to(root))
        command = ["gcc", *OPTIONS, *DEFINITIONS, "-c", "-o", "/dev/null", name]
        result = subprocess.run(command, cwd=root, capture_output=True, text=True)
        if result.returncode != 0:
            violations.append(result.stderr.strip())
    return tree.report(violations, len(paths))


if __name__ == "__main__":
    tree.run(main)
