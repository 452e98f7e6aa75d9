# SPDX-License-Identifier: MIT
"""The flow graph of a function for Cortex-M, read from its disassembly: blocks, calls, loops."""

import re
from dataclasses import dataclass, field

import board
import machine

CONDITIONS = [
    "eq",
    "ne",
    "cs",
    "hs",
    "cc",
    "lo",
    "mi",
    "pl",
    "vs",
    "vc",
    "hi",
    "ls",
    "ge",
    "lt",
    "gt",
    "le",
]
TARGET = re.compile(r"\b([0-9a-f]+) <")
CONDITIONAL = re.compile(rf"^b(?:{'|'.join(CONDITIONS)})(?:\.[nw])?$")


@dataclass
class Block:
    """Instructions that run one after the other."""

    start: int
    instructions: list = field(default_factory=list)
    calls: list = field(default_factory=list)  # names, in order
    follows: set = field(default_factory=set)  # starts of the blocks that may run next
    falls_to: int | None = None  # the one of them that lies behind it
    leaves: bool = False  # whether the function may end with it


def goal(instruction):
    match = TARGET.search(instruction.operands)
    return int(match[1], 16) if match else None


def is_return(instruction):
    """Whether the program counter comes from the stack or from lr."""
    name = instruction.name.split(".")[0]
    if name.startswith(("pop", "ldmia")) and re.search(r"\bpc\b", instruction.operands):
        return True
    if name.startswith("ldr") and instruction.operands.startswith("pc,"):
        return True
    return name.startswith("bx") and instruction.operands.startswith("lr")


def kind(instruction):
    """call, jump, branch, return, table or none of these; and whether it hangs on a condition."""
    name = instruction.name.split(".")[0]
    if is_return(instruction):
        return "return", name not in ("pop", "ldmia", "ldr", "bx")
    if name in ("tbb", "tbh"):
        return "table", False
    if name == "blx" or (name == "bx"):
        raise board.Failure(f"{instruction.address:#x}: a call by address: no path can be told")
    if name == "bl":
        return "call", False
    if name == "b":
        return "jump", False
    if name in ("cbz", "cbnz") or CONDITIONAL.match(instruction.name):
        return "branch", True
    if name.startswith("bl") and name[2:] in CONDITIONS:
        return "call", True
    return "", False


def switch_goals(code, index, data):
    """Where tbb or tbh may go: the table is behind it, the comparison before it says how long."""
    instruction = code[index]
    width = 1 if instruction.name == "tbb" else 2
    for before in reversed(code[max(0, index - 6) : index]):
        match = re.search(r"^cmp(?:\.w)?$", before.name) and re.search(r"#(\d+)", before.operands)
        if match:
            count = int(match[1]) + 1
            break
    else:
        raise board.Failure(f"{instruction.address:#x}: a switch without a limit")
    base = instruction.address + 4
    return {
        base + 2 * int.from_bytes(data(base + width * i, width), "little") for i in range(count)
    }, base + width * count


def blocks_of(code, starts, data):
    """The blocks of a function, by their start."""
    first, last = code[0].address, code[-1].address
    entries, ends, tables = {first}, {}, {}
    skip_until = 0
    kept = []
    for index, instruction in enumerate(code):
        if instruction.address < skip_until:
            continue  # a switch's table, read as instructions
        kept.append(instruction)
        what, _ = kind(instruction)
        if what == "table":
            goals, skip_until = switch_goals(code, index, data)
            tables[instruction.address] = goals
            entries |= goals
        target = goal(instruction) if what in ("jump", "branch") else None
        if target is not None and first <= target <= last:
            entries.add(target)
        if what in ("jump", "branch", "return", "table"):
            ends[instruction.address] = what
    blocks, block = {}, None
    behind = None  # the block that falls through to the next one
    for instruction in kept:
        if block is None or instruction.address in entries:
            if behind is not None:
                behind.follows.add(instruction.address)
                behind.falls_to = instruction.address
            block = Block(instruction.address)
            blocks[instruction.address] = block
        behind = block
        block.instructions.append(instruction)
        what, is_conditional = kind(instruction)
        if what == "call":
            block.calls.append(starts[goal(instruction)])
        if what in ("jump", "branch"):
            target = goal(instruction)
            if first <= target <= last and starts.get(target) != starts[first]:
                block.follows.add(target)
            elif target in starts and what == "jump":
                block.calls.append(starts[target])  # a call at the end of the function
                block.leaves = True
            elif starts.get(target) == starts[first]:
                block.follows.add(target)
            else:
                raise board.Failure(f"{instruction.address:#x}: a branch into another function")
        if what == "table":
            block.follows |= tables[instruction.address]
        if what == "return":
            block.leaves = True
        if what in ("jump", "table") or (what == "return" and not is_conditional):
            behind = None
        if what in ("jump", "branch", "table", "return"):
            block = None
    return blocks


def reachable(blocks, first):
    """Starts of the blocks that the first one leads to."""
    seen, rest = {first}, [first]
    while rest:
        for follower in blocks[rest.pop()].follows - seen:
            seen.add(follower)
            rest.append(follower)
    return seen


def knots(inside, edges):
    """Sets of blocks each of which leads to each other one of its set (Tarjan)."""
    index, low, stack, found = {}, {}, [], []
    follows = {start: sorted(b for a, b in edges if a == start) for start in inside}
    for root in sorted(inside):
        if root in index:
            continue
        work = [(root, iter(follows[root]))]
        index[root] = low[root] = len(index)
        stack.append(root)
        while work:
            start, rest = work[-1]
            for follower in rest:
                if follower not in index:
                    index[follower] = low[follower] = len(index)
                    stack.append(follower)
                    work.append((follower, iter(follows[follower])))
                    break
                if follower in stack:
                    low[start] = min(low[start], index[follower])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[start])
                if low[start] == index[start]:
                    knot = set()
                    while start not in knot:
                        knot.add(stack.pop())
                    found.append(knot)
    return [knot for knot in found if len(knot) > 1 or any((s, s) in edges for s in knot)]


@dataclass
class Loop:
    head: int
    inside: set  # starts of its blocks
    backs: set  # edges to its head from inside
    entries: set  # edges into it
    lines: frozenset = frozenset()  # of the sources: what says that it is a loop


def loops_of(inside, edges):
    """The loops, inner ones first: knots, and what stays knotted without the edges to their head.
    Where a knot has several ways in, its head is the one that most of them lead to."""
    found = []
    for knot in knots(inside, edges):
        entries = {(a, b) for a, b in edges if a not in knot and b in knot}
        heads = [b for _, b in sorted(entries)] or [min(knot)]
        head = max(sorted(set(heads)), key=heads.count)
        within = {(a, b) for a, b in edges if a in knot and b in knot}
        backs = {(a, b) for a, b in within if b == head}
        found += loops_of(knot, within - backs)
        found.append(Loop(head, knot, backs, entries))
    return found


class Program:
    """A program's functions as flow graphs, with the lines of the sources that they come from."""

    def __init__(self, build, name):
        self.build, self.name = build, name
        self.code = {key: code for key, code in machine.disassemble(build, name).items() if code}
        self.starts = {code[0].address: key for key, code in self.code.items()}
        self.image = self.read_image()

    def read_image(self):
        path = self.build.folder / f"{self.name}.text"
        tool = machine.tool(self.build, "objcopy")
        program = self.build.folder / self.name
        board.run([tool, "-O", "binary", "-j", ".text", program, path])
        headers = board.run([machine.tool(self.build, "objdump"), "-h", program])
        begin = int(re.search(r"\.text\s+\w+\s+(\w+)", headers)[1], 16)
        return begin, path.read_bytes()

    def data(self, address, size):
        begin, image = self.image
        return image[address - begin : address - begin + size]

    def blocks(self, function):
        return blocks_of(self.code[function], self.starts, self.data)

    def lines(self, addresses):
        """For each address its places in the sources, innermost first: (function, file, line)."""
        if not addresses:
            return {}
        words = [f"{address:#x}" for address in addresses]
        tool = machine.tool(self.build, "addr2line")
        text = board.run([tool, "-a", "-i", "-f", "-e", self.build.folder / self.name, *words])
        found, place = {}, None
        rows = iter(text.splitlines())
        for row in rows:
            if row.startswith("0x"):
                place = found.setdefault(int(row, 16), [])
                continue
            where = next(rows).split(" ")[0]
            path, _, number = where.rpartition(":")
            place.append((row, path.rpartition("/")[2], int(number) if number.isdigit() else 0))
        return found
