# SPDX-License-Identifier: MIT
"""What the linker and the disassembler say of a program for a target.

    build/venv/bin/python tools/target/machine.py FOLDER_OF_A_BUILD

prints the bytes of flash that each object of the library takes in it.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

import board


def tool(build, name):
    prefix = "arm-none-eabi" if build.target.startswith("cortex") else "riscv64-unknown-elf"
    return f"{prefix}-{name}"


def symbols(build, program):
    """Address and size of each function and object."""
    found = {}
    for line in board.run([tool(build, "nm"), "-S", build.folder / program]).splitlines():
        words = line.split()
        if len(words) == 4:
            is_code = words[2] in "tTwW"
            address = int(words[0], 16)
            # Bit 0 of a function's address says Thumb.
            is_thumb = is_code and build.target.startswith("cortex")
            found[words[3]] = (address & ~1 if is_thumb else address, int(words[1], 16))
    return found


# --- memory ------------------------------------------------------------------------------------

SECTION = re.compile(
    r"^ (\.[\w.$]+)\s+0x[0-9a-f]+\s+0x([0-9a-f]+)\s+\S*libbelt\.a\((\w+)\.c\S*\)", re.MULTILINE
)


def library_objects(build, program="belt_footprint"):
    """Bytes of .text, .rodata, .data and .bss of each object that the linker took from libbelt.a,
    by its map."""
    text = (build.folder / f"{program}.map").read_text(encoding="utf-8")
    text = text.partition("Linker script and memory map")[2]
    objects = {}
    for section, size, name in SECTION.findall(text):
        kind = section.split(".")[1]
        if kind in ("srodata", "sdata", "sbss"):
            kind = kind[1:]
        sizes = objects.setdefault(name, dict.fromkeys(("text", "rodata", "data", "bss"), 0))
        if kind in sizes:
            sizes[kind] += int(size, 16)
    return objects


def flash_of(sizes):
    """Bytes that an object takes of the flash."""
    return sizes["text"] + sizes["rodata"] + sizes["data"]


# --- instructions ------------------------------------------------------------------------------


@dataclass(frozen=True)
class Instruction:
    address: int
    name: str
    operands: str


LINE = re.compile(r"^\s*([0-9a-f]+):\t(\S+)(?:\t(.*))?$")


def disassemble(build, program):
    """The instructions of each function, in order."""
    functions = sorted(
        (address, address + size, name)
        for name, (address, size) in symbols(build, program).items()
        if size
    )
    text = board.run([tool(build, "objdump"), "-d", "--no-show-raw-insn", build.folder / program])
    found = {name: [] for _, _, name in functions}
    at = 0
    for line in text.splitlines():
        match = LINE.match(line)
        if not match or match[2].startswith("."):
            continue
        address = int(match[1], 16)
        while at < len(functions) and functions[at][1] <= address:
            at += 1
        if at < len(functions) and functions[at][0] <= address:
            operands = re.split(r"\s*[@#;] 0x|\s+@", match[3] or "")[0]
            found[functions[at][2]].append(Instruction(address, match[2], operands.strip()))
    return found


# --- the deepest stack ---------------------------------------------------------------------------


def registers(text):
    """How many a list {r4-r7, lr} names."""
    count = 0
    for part in re.search(r"\{(.*)\}", text)[1].split(","):
        first, _, last = part.strip().partition("-")
        count += int(last[1:]) - int(first[1:]) + 1 if last else 1
    return count


def pushed(instruction):
    """Bytes by which it moves the stack pointer down."""
    name, operands = instruction.name.split(".")[0], instruction.operands
    if name == "push" or (name == "stmdb" and operands.startswith("sp!")):
        return 4 * registers(operands)
    if name == "vpush":
        return (8 if "{d" in operands else 4) * registers(operands)
    if match := re.search(r"\[sp, #-(\d+)\]!", operands):
        return int(match[1])
    if name in ("sub", "subw"):
        match = re.fullmatch(r"sp, (?:sp, )?#(\d+)", operands)
        return int(match[1]) if match else 0
    if name in ("addi", "add"):
        match = re.fullmatch(r"sp,\s*sp,\s*-(\d+)", operands)
        return int(match[1]) if match else 0
    return 0


BRANCHES = re.compile(r"([0-9a-f]+) <")
RETURNS_BY_REGISTER = re.compile(r"^(lr|x?ra|0\(ra\)|t0)$")


def callees(build, name, functions, starts):
    """The functions it may go to."""
    for instruction in functions[name]:
        match = BRANCHES.search(instruction.operands)
        if match and not instruction.name.startswith(("ldr", "vldr", "adr", "lw", "auipc")):
            target = starts.get(int(match[1], 16))
            if target is not None and target != name:
                yield target


def deepest_stack(build, program, root):
    """Bytes below the stack pointer at the call of `root`, by the frames and calls in the binary,
    and the functions on that way. An upper bound: of a function all its frames count at once."""
    functions = disassemble(build, program)
    starts = {code[0].address: name for name, code in functions.items() if code}
    known = {}

    def depth(name, above):
        if name in above:
            raise board.Failure(f"{name} calls itself: the stack has no bound")
        if name not in known:
            own = sum(map(pushed, functions[name]))
            below = [
                depth(other, (*above, name))
                for other in set(callees(build, name, functions, starts))
            ]
            most, way = max(below, default=(0, ()))
            known[name] = own + most, (name, *way)
        return known[name]

    return depth(root, ())


if __name__ == "__main__":
    parts = {
        name: flash_of(sizes)
        for name, sizes in library_objects(board.Build("", Path(sys.argv[1]))).items()
    }
    for name, size in sorted(parts.items(), key=lambda part: -part[1]):
        print(f"{size:6} {name}.c")
    print(f"{sum(parts.values()):6} all")
