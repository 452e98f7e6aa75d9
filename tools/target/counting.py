# SPDX-License-Identifier: MIT
"""Instructions of each belt_step on an emulated board, sorted by what the step did."""

import collections
import itertools
import tempfile
from dataclasses import dataclass
from pathlib import Path

import board
import machine
import stimuli

LATE_BITS = 0x200 | 0x400  # of measurement.h: periods were made up for
AUTOMATIC = 2


@dataclass(frozen=True)
class Step:
    """One call of belt_step."""

    instructions: int
    mode: int
    error_bits: int
    is_first: bool  # since its controller was initialised
    stimulus: int  # which one it belongs to
    index: int  # which step of it

    def is_good_automatic(self):
        return self.mode == AUTOMATIC and self.error_bits == 0 and not self.is_first

    def is_late(self):
        return bool(self.error_bits & LATE_BITS)


def play(build, plugin, folder, streams, program="belt_server"):
    """What the plugin counts while all streams run one after the other on one board: instructions
    and leaps of each call, how often each instruction ran; and the replies."""
    functions = machine.symbols(build, program)
    begin, _ = functions["belt_step"]
    caller, size = functions["server_step"]
    options = (
        f"{plugin},begin={begin:#x},caller={caller:#x},caller_end={caller + size:#x},out=counts"
    )
    requests = b"".join(streams)
    replies = board.replay(build.command(program, "-plugin", options), folder, requests)
    calls, ran = [], collections.Counter()
    for line in (folder / "counts").read_text(encoding="utf-8").splitlines():
        kind, *numbers = line.split()
        if kind == "call":
            calls.append(tuple(map(int, numbers)))
        else:
            ran[int(numbers[0], 16)] += int(numbers[1])
    return calls, ran, replies


def count(build, plugin, streams):
    """The steps of all streams."""
    with tempfile.TemporaryDirectory() as folder:
        calls, _, replies = play(build, plugin, Path(folder), streams)
    return list(steps(streams, replies, [instructions for instructions, _ in calls]))


def last_step(build, plugin, stream, without_it):
    """Of the last step of a stream, which is also given without it: how often each instruction ran,
    and the leaps."""
    played = []
    for part in (stream, without_it):
        with tempfile.TemporaryDirectory() as folder:
            played.append(play(build, plugin, Path(folder), [part]))
    (calls, ran, _), (_, ran_before, _) = played
    ran.subtract(ran_before)
    instructions, leaps = calls[-1]
    if sum(ran.values()) != instructions:
        raise board.Failure("the last step of a stream is not the one that was counted")
    return ran, leaps


def steps(streams, replies, calls):
    answers = stimuli.messages(replies)
    counts = iter(calls)
    for number, stream in enumerate(streams):
        is_first, is_ready = True, False
        indices = itertools.count()
        for what, _ in stimuli.messages(stream):
            status, words = next(answers)
            if what == stimuli.INIT:
                is_first, is_ready = True, status == 0
            if what == stimuli.STEP:
                instructions = next(counts)
                if is_ready:
                    yield Step(instructions, words[1], words[2], is_first, number, next(indices))
                is_first = False
    if next(counts, None) is not None:
        raise board.Failure("more steps were counted than asked for")
