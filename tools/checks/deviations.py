# SPDX-License-Identifier: MIT
"""Findings of a tool that stay, each with its reason: lists in tools/checks/NAME_deviations.txt.

A line is `RULE PLACE reason`, PLACE a pattern of paths below the root; what is indented goes on
with the reason. An entry that no finding needs is a violation too: the list says what there is.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path


@dataclass(frozen=True)
class Finding:
    rules: tuple[str, ...]  # the tool's names for it
    path: str  # below the root
    line: int
    text: str


@dataclass(frozen=True)
class Deviation:
    rule: str
    place: str
    reason: str

    def covers(self, finding: Finding) -> bool:
        return self.rule in finding.rules and fnmatchcase(finding.path, self.place)


def entries(path: Path) -> Iterator[Deviation]:
    if not path.is_file():
        return
    lines: list[str] = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith((" ", "\t")) and line.strip() and lines:
            lines[-1] += " " + line.strip()
        elif line.strip() and not line.startswith("#"):
            lines.append(line)
    for line in lines:
        rule, place, reason = [*line.split(maxsplit=2), "", ""][:3]
        yield Deviation(rule, place, reason.strip())


def violations(root: Path, name: str, findings: Iterable[Finding]) -> Iterator[str]:
    """What the list does not cover, and what of the list covers nothing."""
    path = root / "tools" / "checks" / f"{name}_deviations.txt"
    listed = list(entries(path))
    needed = set()
    for finding in findings:
        covering = [deviation for deviation in listed if deviation.covers(finding)]
        needed.update(covering)
        if not covering:
            rules = ", ".join(finding.rules)
            yield f"{finding.path}:{finding.line}: {rules}: {finding.text}"
    for deviation in listed:
        if not deviation.reason:
            yield f"{path.name}: {deviation.rule} {deviation.place}: no reason given"
        if deviation not in needed:
            yield f"{path.name}: {deviation.rule} {deviation.place}: nothing deviates any more"
