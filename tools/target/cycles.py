# SPDX-License-Identifier: MIT
"""An estimate of cycles on a Cortex-M4 with FPU, by the counts of its technical reference manual.

Memory without wait states, no interrupts. Where the manual gives a range, its greatest: 3 for a
refill of the pipeline, 12 for a division of integers. Of its rules on neighbours: a load or store
behind a load is pipelined, unless its address comes from there; an address that the instruction
before has computed costs a cycle, and so does a result of the FPU that the next one takes up. Not
in: integer instructions that run beside a float division, and the literals that the fetch has to
wait for. Nothing of this is measured.
"""

import re

import board
import flow
import machine

REFILL = 3  # at a leap: a branch that is taken, a call, a return

CONDITION = re.compile(rf"(?:{'|'.join(flow.CONDITIONS)})$")
COMPUTES = re.compile(
    r"^(?:mov[wt]?|mvn|addw?|subw?|adc|sbc|rsb|neg|mul|ml[as]|[us]mull|[us]mlal|and|orr|orn|eor|bic"
    r"|lsl|lsr|asr|ror|rrx|clz|rev|[us]xt[bh]|[us]bfx|bfi|bfc)s?$"
)
DECIDES = re.compile(r"^(?:cmp|cmn|tst|teq|it[te]*|cbn?z|b|bl|bx|nop)$")
LOAD, STORE = re.compile(r"^ldrs?[bh]?$"), re.compile(r"^str[bh]?$")
SEVERAL = re.compile(r"^(?:push|pop|vpush|vpop|v?ldm(?:ia|db)?|v?stm(?:ia|db)?)$")
FLOAT = re.compile(r"^v(?:add|sub|mul|nmul|cvt|div|sqrt|n?ml[as]|fn?m[as])$")
OTHER_FLOAT = re.compile(r"^v(?:cmpe?|abs|neg|mrs|msr)$")
ONE = [COMPUTES, DECIDES, FLOAT, OTHER_FLOAT]
MORE = {"ldrd": 3, "strd": 3, "udiv": 12, "sdiv": 12, "tbb": 3, "tbh": 3, "vdiv": 14, "vsqrt": 14}
MORE |= dict.fromkeys(("vmla", "vmls", "vnmla", "vnmls", "vfma", "vfms", "vfnma", "vfnms"), 3)
BY_OPERANDS = {"vldr", "vstr", "vmov"}
CORE_REGISTER = re.compile(r"\b(?:r\d+|s[bl]|fp|ip|sp|lr)\b")


def is_known(name):
    return (
        name in MORE
        or name in BY_OPERANDS
        or any(kind.match(name) for kind in [*ONE, LOAD, STORE, SEVERAL])
    )


def name_of(instruction):
    """Its name without condition, width and type."""
    name = instruction.name.split(".")[0]
    return name if is_known(name) else CONDITION.sub("", name)


def alone(name, operands):
    """Cycles of an instruction, its neighbours and refills apart."""
    if name in MORE:
        return MORE[name]
    if SEVERAL.match(name):
        return 1 + machine.registers(operands) * (2 if "{d" in operands else 1)
    if LOAD.match(name):
        return 2
    if STORE.match(name):
        return 1 if re.search(r"\[\w+(?:, #-?\d+)?\]", operands) else 2
    if name == "vmov":
        return 2 if CORE_REGISTER.search(operands) else 1
    if name in BY_OPERANDS:
        return 3 if operands.startswith("d") else 2
    if any(kind.match(name) for kind in ONE):
        return 1
    raise board.Failure(f"no count of cycles for {name} {operands}")


def taken_up(name, operands):
    """What a float instruction reads of the FPU."""
    words = re.split(r",\s*", operands)
    return words if name.startswith(("vcmp", "vstr", "vml", "vnml", "vf")) else words[1:]


def behind(name, operands, before):
    """What an instruction takes more or less for the one before it."""
    name_before = name_of(before)
    result = before.operands.split(",")[0]
    has_its_address = result in re.split(r"\W+", "".join(re.findall(r"\[(.*)\]", operands)))
    is_pipelined = LOAD.match(name) or (STORE.match(name) and alone(name, operands) > 1)
    if LOAD.match(name_before) and is_pipelined and not has_its_address:
        return -1
    if COMPUTES.match(name_before) and has_its_address:
        return 1
    if FLOAT.match(name_before) and name.startswith("v") and result in taken_up(name, operands):
        return 1
    return 0


def weigher(functions):
    """Gives a function: cycles of an instruction of the program. The one before it is the one that
    lies before it; where a branch leads to, that may only add."""
    before, goals = {}, set()
    for code in functions.values():
        before |= {second.address: first for first, second in zip(code, code[1:])}
        goals |= {flow.goal(instruction) for instruction in code}

    def weigh(instruction):
        name, operands = name_of(instruction), instruction.operands
        first = before.get(instruction.address)
        more = behind(name, operands, first) if first else 0
        return alone(name, operands) + max(more, 0 if instruction.address in goals else -1)

    return weigh


def of_steps(functions):
    """Gives a function: cycles of a step, by how often each instruction ran in it and its leaps."""
    weigh = weigher(functions)
    at = {instruction.address: instruction for code in functions.values() for instruction in code}

    def cycles(ran, leaps):
        return sum(weigh(at[address]) * times for address, times in ran.items()) + REFILL * leaps

    return cycles
