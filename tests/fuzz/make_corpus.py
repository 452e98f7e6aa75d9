# SPDX-License-Identifier: MIT
"""Writes the seed corpora of tests/fuzz: what each harness starts from.

    build/venv/bin/python tests/fuzz/make_corpus.py

The encodings are those that the head of each harness states. Inputs in corpus/ that are not named
here were found by a campaign and kept; they stay.
"""

import struct
from pathlib import Path

CORPUS = Path(__file__).resolve().parent / "corpus"

# The bits of a measurement, and of a harness's action byte.
LEVEL, OUTLET, APPLIED, DENSITY, SAMPLE, TICKS, NO_DENSITY = (1 << bit for bit in range(7))
SETPOINT, ANY_COUNTS, ANY_PRESENT, OPERATOR = 0x80, 0x40, 0x20, 0x10
OFF, MANUAL, AUTOMATIC, MANUAL_FLUX = 0, 1, 2, 0x80
ON_TIME = 1 << 2
NAN, INFINITE, GREATEST, LEAST = 0xD1, 0xD2, 0xD4, 0xD7


def any_number(value: float) -> bytes:
    return bytes([0xFF]) + struct.pack("<f", value)


def step_seeds() -> dict[str, bytes]:
    on_time = [bytes([ON_TIME | count, LEVEL | SAMPLE | TICKS, 0x26]) for count in (0, 1, 2, 3)]
    everything = bytes([ON_TIME, LEVEL | OUTLET | APPLIED | DENSITY, 0x30, 0x40, 0x50, 0x20, 0x60])
    seeds = {f"on_time_{start}": bytes([start]) + b"".join(on_time) for start in range(8)}
    seeds |= {f"all_inputs_{start}": bytes([start]) + 2 * everything for start in range(8)}
    seeds |= {
        "no_level": bytes([1, 0, 0, 0, ON_TIME, LEVEL, 0x20]),
        "not_a_number": bytes([1, 0, LEVEL, NAN, 0, LEVEL, INFINITE, 0, LEVEL, 0x20]),
        "out_of_range": bytes([3, 0, LEVEL, 0xBF, 0, LEVEL, 0xCF, 0, LEVEL, GREATEST]),
        "fluxes_at_the_ends": bytes([5, 0, LEVEL | OUTLET | APPLIED, 0x20, GREATEST, LEAST]),
        "density_missing": bytes([5, 0, LEVEL | DENSITY | NO_DENSITY, 0x20]),
        "manual": bytes([3, OPERATOR, LEVEL, MANUAL, 0x20, OPERATOR, LEVEL, MANUAL_FLUX, 0x40])
        + bytes([0x20, OPERATOR, LEVEL, AUTOMATIC, 0x20, OPERATOR, LEVEL, OFF, 0x20]),
        "lost_and_found": bytes([3, *(4 * [0, 0, 0]), 0, LEVEL, 0x20, 0, LEVEL, 0x21]),
        "setpoint": bytes([1, SETPOINT, LEVEL, 0x30, 0x20, SETPOINT, LEVEL, NAN, 0x20]),
        "late": bytes([1, ANY_COUNTS, LEVEL | TICKS]) + struct.pack("<II", 1, 37) + b"\x20",
        "lost": bytes([1, ANY_COUNTS, LEVEL | TICKS]) + struct.pack("<II", 1, 1 << 31) + b"\x20",
        "repeated": bytes([1, 0, LEVEL | TICKS, 0x20, 0, LEVEL | TICKS, 0x20]),
        "mismatch": bytes([3, *(6 * [ON_TIME, LEVEL | APPLIED, 0x20, 0x70])]),
        "any_present": bytes([7, ANY_PRESENT, 0, 0xFF, 0xFF, 0xFF, 0xFF]) + any_number(-1e30),
    }
    return seeds


def config_seeds() -> dict[str, bytes]:
    seeds = {f"sound_{case}": bytes([case]) for case in range(4)}
    for field in range(21):
        seeds[f"double_{field}"] = bytes([0, field, 144])
        seeds[f"half_{field}"] = bytes([1, field, 112])
        seeds[f"not_a_number_{field}"] = bytes([2, 0x80 + field, NAN])
    seeds["exchanged"] = bytes([3, 0xC0, 0x50, 0x00, 1, 2, 3, 4])
    seeds["laid_over"] = bytes([0, 0xE0]) + bytes(64) + b"\x01\x02\x03"
    return seeds


def scenario_seeds() -> dict[str, bytes]:
    return {
        "empty": b"",
        "setting": b"\0line.rework_rate=0.2\0[line]\nrework_rate = 0.1\n",
        "comments": b"# one\n; two\n\n[law]\n# three\nlevel_setpoint = 0.3\n",
        "windows": b"[controller]\r\nlaw = frozen\r\nnode_count = 40\r\n",
        "lists": b"[line]\nloss_rate = 0.4, 1.2,2e-1\n[run]\nduration = 1e1\n"
        b"setpoint_times = 2, 4\nsetpoint_levels = 0.4, 0.2\n",
        "plant": b"[plant]\nscheme = upwind\nsubsteps = 4\nloss_rate = 1\n",
        "refused": b"[line]\nbelt_length = -2\n",
        "twice": b"[line]\n[line]\n",
        "utf_8": b"# \xc3\xa9\xe2\x82\xac\xf0\x9f\x99\x82\n",
    }


def snapshot_seeds() -> dict[str, bytes]:
    """The bits of a change: any offset and byte; 0x80: the CRC is made right again."""
    none, one, sealed = bytes(8), bytes([0, 0, 1, 0x40, 0x01, 0xFF]), 0x80
    seeds = {f"whole_{start}": bytes([start]) + none for start in range(4)}
    seeds |= {f"long_stop_{start}": bytes([start, 0xFF, 0x01, 0, 0]) for start in range(4)}
    seeds |= {
        "one_byte": bytes([0]) + one,
        "one_byte_sealed": bytes([sealed]) + one,
        "both_slots": bytes([0, 0, 0, 0, 0, 0x40, 0x00, 1, 0x40, 0x80, 1]),
    }
    return seeds


SEEDS = {
    "step": step_seeds,
    "config": config_seeds,
    "scenario": scenario_seeds,
    "snapshot": snapshot_seeds,
}


def main() -> None:
    for target, seeds in SEEDS.items():
        folder = CORPUS / target
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in seeds().items():
            (folder / name).write_bytes(content)
        print(f"{target}: {len(seeds())} seeds")


if __name__ == "__main__":
    main()
