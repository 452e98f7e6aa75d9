# SPDX-License-Identifier: MIT
"""One mode with one number of nodes: its inputs, and what they cost on each target."""

import board
import core
import counting
import cycles
import inputs
import machine

SEARCHED = "cortex-m4f"  # the target of the search, of the longest path and of the estimate
NODE_COUNTS = [10, 20, 40, 80]
EFFORT = {True: (6, 12), False: (12, 24)}  # rounds of the search and stimuli in each; first: quick
# Where each float operation is a function: of a scenario's run so many steps.
SOFT_FLOAT = {"cortex-m3", "cortex-m0", "rv32imac"}
SOFT_FLOAT_STEPS = 1200
# Simulating the core takes 6 s a million cycles: of each mode the beginning of a run, and the worst
# inputs; of the mode whose steps are longest fewer nodes.
CORE_STEPS = 120
CORE_NODES = {"law": NODE_COUNTS, "full": NODE_COUNTS, "profile": NODE_COUNTS, "late": [10, 20]}


def measure(steps, mode):
    """Least and greatest of the steps of a mode, and the worst of them."""
    chosen = [step for step in steps if inputs.belongs(step, mode)]
    if not chosen:
        raise board.Failure(f"no step of mode {mode} was counted")
    worst = max(chosen, key=lambda step: step.instructions)
    least = min(step.instructions for step in chosen)
    row = {"instructions_min": least, "instructions_max": worst.instructions, "steps": len(chosen)}
    if mode == "law":
        row["first"] = max(step.instructions for step in steps if step.is_first)
    return row, worst


def estimate(binary, plugin, stream, index):
    """Cycles of a step by the manual's counts."""
    parts = inputs.cut(stream, index), inputs.cut(stream, index - 1)
    of_step = cycles.of_steps(machine.disassemble(binary.build, "belt_server"))
    return of_step(*counting.last_step(binary.build, plugin, *parts))


def with_path(row, path):
    """A row with the longest path of its mode, which nothing that was observed may exceed."""
    row = row | {"path": path[0], "path_estimate": path[1]}
    if row["path"] < row["instructions_max"] or row["path_estimate"] < row["estimate"]:
        raise board.Failure(f"{row['mode']}: more was observed than the longest path has")
    return row


class Case:
    """One mode with one number of nodes: its inputs, and what they cost on each target."""

    def __init__(self, given, pc, binaries, node_count, mode):
        self.given, self.pc, self.binaries = given, pc, binaries
        self.node_count, self.mode = node_count, mode
        self.plugin = pc.folder / "count_plugin.so"
        self.recorded = inputs.recordings(pc, node_count, mode)
        self.found = inputs.search(self.count, mode, node_count, EFFORT[given.quick])

    def count(self, streams):
        return counting.count(self.binaries[SEARCHED, self.node_count].build, self.plugin, streams)

    def rows(self):
        for target in self.given.target:
            if target != core.TARGET:
                yield self.row(target)
            elif self.node_count in CORE_NODES[self.mode]:
                yield self.core_row()

    def streams(self, target):
        streams = [*self.recorded, *self.found, *inputs.kept(target, self.node_count, self.mode)]
        if target in SOFT_FLOAT:
            return [inputs.cut(stream, SOFT_FLOAT_STEPS) for stream in streams]
        return streams

    def row(self, target):
        binary, streams = self.binaries[target, self.node_count], self.streams(target)
        steps = counting.count(binary.build, self.plugin, streams)
        row, worst = measure(steps, self.mode)
        row = {"target": target, "node_count": self.node_count, "mode": self.mode} | row
        stream = streams[worst.stimulus]
        if self.given.worst:
            self.given.worst.mkdir(parents=True, exist_ok=True)
            name = inputs.kept_name(target, self.node_count, self.mode)
            (self.given.worst / name).write_bytes(inputs.cut(stream, worst.index))
        if self.mode in binary.paths:
            row["estimate"] = estimate(binary, self.plugin, stream, worst.index)
            row = with_path(row, binary.paths[self.mode])
        return row | binary.sizes

    def core_row(self):
        """Cycles on the core, of the beginning of a run and of worst inputs."""
        streams = [inputs.cut(self.recorded[0], CORE_STEPS)]
        streams += inputs.kept(SEARCHED, self.node_count, self.mode)
        _, worst = measure(self.count(self.found[:1]), self.mode)
        streams.append(inputs.cut(self.found[0], worst.index))
        steps = core.count(self.binaries[core.TARGET, self.node_count].build, self.pc, streams)
        chosen = [step.instructions for step in steps if inputs.belongs(step, self.mode)]
        taken, done = zip(*chosen)
        return {
            "target": core.TARGET,
            "node_count": self.node_count,
            "mode": self.mode,
            "cycles_min": min(taken),
            "cycles_max": max(taken),
            "instructions_min": min(done),
            "instructions_max": max(done),
            "steps": len(chosen),
        }
