# SPDX-License-Identifier: MIT
"""A structural upper estimate of the instructions of belt_step on a Cortex-M with FPU, and of their
cycles by the manual's counts (cycles.py): the longest path through the binary.

For each function the greatest sum of instructions over all ways through its flow graph is found by
linear programming, callees counting with their own greatest sum. What the graph cannot tell stands
in BOUNDS below: how often each loop goes round. It holds without interrupts.

    build/venv/bin/python tools/target/longest_path.py FOLDER_OF_A_BUILD NODE_COUNT

prints a JSON object with the paths of each mode of tools/cost: [instructions, cycles].
"""

import dataclasses
import json
import sys
from pathlib import Path

import board
import cycles
import flow
import machine
import numpy as np
from scipy.optimize import linprog

PROGRAM, ROOT = "belt_server", "belt_step"
MODES = ["law", "full", "profile", "late"]

# For each loop, by its function and the line that makes it one: the most rounds each time it is
# entered, and the most of all its rounds in one call of the function it was compiled into ("" if
# that is no less). n: node_count, places: densities that are measured, periods: what a step makes
# up for, size: bytes of the largest sealed block.
BOUNDS = [
    ("belt_model_follow", "while (passed <", "periods", ""),
    ("record_level", "for (uint32_t i = 1; i < periods", "periods - 1", "periods - 1"),
    ("gate_density", "for (uint32_t i = 0; i <= line->node_count", "places", ""),
    ("belt_integrity_sum", "for (; left >= 4u", "size // 16", ""),
    ("belt_integrity_sum", "for (; left > 0u", "3", ""),
    ("belt_observer_assume", "for (uint32_t i = 0; i < line->node_count", "n", ""),
    ("belt_march_plain_pairs", "for (uint32_t i = 0; i < pairs", "(n - 1) // 2", ""),
    ("leave_plain", "for (int i = 0; i < 2", "2", ""),
    ("march_pairs", "for (uint32_t i = 0; i < pairs", "(n - 1) // 2", ""),
    # The window's end only ever moves forward, over at most all lines between the stretches.
    ("belt_march_predicted_level", "while ((line < count", "n // 2 + 1", "n // 2 + 1"),
    ("belt_fast_forward", "for (uint32_t i = 0; i < passed->count", "n // 2 + 1", ""),
    ("age_profile", "for (uint32_t i = 1; i < line->node_count", "n - 1", ""),
    ("age_uniform", "for (uint32_t cell = from", "n - 1", "n - 1"),
    ("age_uniform", "for (int run = 0; run < 2", "2", ""),
]

# What a mode never enters, by the functions of the sources.
UNIFORM = {"march_pairs", "leave_any", "age_profile", "while_they_pass", "belt_fast_forward"}
NEVER = {
    "law": UNIFORM
    | {"begin", "step_without_level", "belt_observer_assume", "belt_estimator_correct"},
    "full": UNIFORM,
    "profile": set(),
    "late": set(),
}
SEALED = "offsetof(belt_controller_t, model) + offsetof(belt_line_t, loss)"


class Estimate:
    """The longest paths of one program, in one mode: the sum of what each instruction weighs, and
    of `leap` for each branch that is taken, each call and each return."""

    def __init__(self, program, facts, never, weigh, leap):
        self.program, self.facts, self.never = program, facts, never
        self.weigh, self.leap = weigh, leap
        self.known = {}

    def of(self, function):
        if function not in self.known:
            self.known[function] = self.solve(function)
        return self.known[function]

    def solve(self, function):
        blocks = self.program.blocks(function)
        first = self.program.code[function][0].address
        places = self.program.lines(
            [line.address for block in blocks.values() for line in block.instructions]
        )
        open_blocks = {start for start in blocks if not self.is_never(blocks[start], places)}
        blocks = {
            start: dataclasses.replace(block, follows=block.follows & open_blocks)
            for start, block in blocks.items()
            if start in open_blocks
        }
        if first not in blocks:
            raise board.Failure(f"{function} begins with what the mode never enters")
        inside = flow.reachable(blocks, first)
        edges = {(start, b) for start in inside for b in blocks[start].follows}
        return self.longest(function, blocks, first, inside, edges, places)

    def is_never(self, block, places):
        """Whether all of a block comes from what is never entered: what is only partly from there
        stays, which errs on the safe side."""
        return not self.never.isdisjoint(block.calls) or all(
            any(name in self.never for name, _, _ in places[instruction.address])
            for instruction in block.instructions
        )

    def cost(self, block):
        """What a block weighs, with the functions that it calls."""
        own = sum(self.weigh(instruction) for instruction in block.instructions)
        return own + sum(self.leap + self.of(name) for name in block.calls)

    def way_out(self, block, follower):
        """What it takes to go on to the next block, or to return: None."""
        return 0 if follower is not None and follower == block.falls_to else self.leap

    def longest(self, function, blocks, first, inside, edges, places):
        order = sorted(edges) + [(start, None) for start in sorted(inside) if blocks[start].leaves]
        column = {edge: index for index, edge in enumerate(order)}
        cost = {start: self.cost(blocks[start]) for start in inside}
        equal, equal_to = [], []
        for start in sorted(inside):
            row = np.zeros(len(order))
            for edge, index in column.items():
                row[index] += (edge[0] == start) - (edge[1] == start)
            equal.append(row)
            equal_to.append(1.0 if start == first else 0.0)
        below, limits, in_all = [], [], {}
        for loop, bound in self.bounded(function, blocks, inside, edges, places):
            each, total = (eval(text, {}, self.facts) if text else None for text in bound[2:])
            latches = {a for a, _ in loop.backs}
            exits = {a for a, b in order if a in loop.inside and b not in loop.inside}
            if exits <= latches:
                each = max(each - 1, 0)  # the question is asked at the end of a round
            row = np.zeros(len(order))
            for edge in loop.backs:
                row[column[edge]] += 1.0
            if total is not None:
                in_all.setdefault(bound, [np.zeros(len(order)), total])[0] += row
            for edge in loop.entries:
                row[column[edge]] -= each
            below.append(row)
            limits.append(float(each) if first in loop.inside else 0.0)
        for row, total in in_all.values():
            below.append(row)
            limits.append(float(total))
        gain = np.array([-float(cost[a] + self.way_out(blocks[a], b)) for a, b in order])
        found = linprog(
            gain,
            A_ub=np.array(below) if below else None,
            b_ub=limits if below else None,
            A_eq=np.array(equal),
            b_eq=equal_to,
            bounds=(0, None),
            method="highs",
        )
        if found.status != 0:
            raise board.Failure(f"{function}: {found.message}")
        return int(round(-found.fun))

    def bounded(self, function, blocks, inside, edges, places):
        """Each loop with its line of BOUNDS."""
        claimed = []
        for loop in flow.loops_of(inside, edges):
            found = self.lines_of(loop, blocks, places)
            within = [lines for other, lines in claimed if other <= loop.inside]
            own = found.difference(*within) or found
            matches = {
                bound
                for name, text in own
                for bound in BOUNDS
                if bound[0] == name and text.startswith(bound[1])
            }
            if len(matches) != 1:
                raise board.Failure(f"{function}: a loop without one bound: {sorted(own)}")
            claimed.append((loop.inside, found))
            yield loop, matches.pop()

    def lines_of(self, loop, blocks, places):
        """The lines of the sources that begin with for or while and that its blocks come from."""
        found = set()
        for start in loop.inside:
            for instruction in blocks[start].instructions:
                for name, file, number in places[instruction.address]:
                    text = source(file, number)
                    if text.startswith(("for (", "while (")):
                        found.add((name, text))
        return found


def source(file, number):
    path = board.ROOT / "firmware" / "belt" / file
    if number == 0 or not path.is_file():
        return ""
    return path.read_text(encoding="utf-8").splitlines()[number - 1].strip()


def sealed_size(build):
    """Bytes of the largest block that is summed up, as the compiler lays it out."""
    folder = build.folder / "sealed"
    folder.mkdir(exist_ok=True)
    text = f'#include "belt/belt.h"\nchar sealed[{SEALED} - offsetof(belt_controller_t, law)];\n'
    (folder / "sealed.c").write_text(text, encoding="utf-8")
    options = ["-mcpu=cortex-m4", "-mthumb", "-I", board.ROOT / "firmware", "-c"]
    compiler = [machine.tool(build, "gcc"), *options]
    board.run([*compiler, folder / "sealed.c", "-o", folder / "sealed.o"])
    return machine.symbols(board.Build(build.target, folder), "sealed.o")["sealed"][1]


def main(argv):
    build = board.Build("cortex-m4f", Path(argv[1]))
    program = flow.Program(build, PROGRAM)
    facts = {"n": int(argv[2]), "size": sealed_size(build)}
    measures = [(lambda _: 1, 0), (cycles.weigher(program.code), cycles.REFILL)]
    paths = {}
    for mode in MODES:
        facts["periods"] = 100 if mode == "late" else 1
        facts["places"] = 0 if mode == "law" else facts["n"] + 1
        paths[mode] = [
            Estimate(program, facts, NEVER[mode], weigh, leap).of(ROOT) for weigh, leap in measures
        ]
    print(json.dumps(paths))


if __name__ == "__main__":
    try:
        main(sys.argv)
    except board.Failure as failure:
        sys.exit(f"longest_path: {failure}")
