# SPDX-License-Identifier: MIT
"""No function of the firmware or the simulator has more than ten independent ways through it.

Counted by lizard; a switch counts as one decision (lizard's modified count): a flat list of cases
is read as a table. What stays above is listed with its reason in complexity_deviations.txt.
"""

import deviations
import lizard
import tree
from lizard_ext.lizardmodified import LizardExtension as SwitchCountsOnce

MOST = 10


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    paths = [path for path in tree.files(root, "firmware/belt", "host_sim") if tree.is_c(path)]
    analyze = lizard.FileAnalyzer(lizard.get_extensions([SwitchCountsOnce()]))
    findings = [
        deviations.Finding(
            (function.name,),
            path.relative_to(root).as_posix(),
            function.start_line,
            f"{function.cyclomatic_complexity} ways, at most {MOST}",
        )
        for path in paths
        for function in analyze(str(path)).function_list
        if function.cyclomatic_complexity > MOST
    ]
    faults = list(deviations.violations(root, "complexity", findings))
    return tree.report(faults, len(paths))


if __name__ == "__main__":
    tree.run(main)
