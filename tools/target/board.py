# SPDX-License-Identifier: MIT
"""Builds for the targets, and programs on emulated boards; for tools/pil and tools/cost."""

import contextlib
import json
import os
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = ROOT / "build" / "venv" / "bin" / "python"  # with the packages of requirements.txt
HANG = 600  # s: nothing here takes as long; not a claim about speed
NO_ROOM = 3  # belt_sim_remote: the capacities of the controller's build are too small

HOSTS = {"host": "gcc", "host-clang": "clang-19"}  # the PC as a target, and its compiler


class Failure(Exception):
    """Something could not be built or run; the text says what."""


def targets():
    """The targets' names: the presets that inherit `target`."""
    presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    return [
        preset["name"]
        for preset in presets["configurePresets"]
        if preset.get("inherits") == "target"
    ]


def run(command, **more):
    """A command to its end; its output where it fails."""
    try:
        result = subprocess.run(
            list(map(str, command)), cwd=ROOT, capture_output=True, text=True, timeout=HANG, **more
        )
    except FileNotFoundError:
        raise Failure(f"{command[0]} is not installed; tools/setup target brings it") from None
    except subprocess.TimeoutExpired:
        raise Failure(f"{command[0]} did not end within {HANG} s") from None
    if result.returncode != 0:
        raise Failure(f"{' '.join(map(str, command))}:\n{result.stdout}{result.stderr}")
    return result.stdout


@dataclass(frozen=True)
class Build:
    """A folder with programs for one target."""

    target: str
    folder: Path

    def command(self, program, *options):
        """The words that run a program: on the PC, or on the emulated board."""
        path = self.folder / program
        if not path.is_file():
            raise Failure(f"{path} is not built")
        if self.target in HOSTS:
            return [str(path)]
        emulator = (self.folder / "emulator").read_text(encoding="utf-8").split("\n")
        return [*filter(None, emulator), str(path), *options]


def build(target, optimization="O2", defines=(), folder=None, programs=("belt_server",)):
    """Configures and builds; what is built already is left as it is."""
    preset = "host" if target in HOSTS else target
    plain = optimization == "O2" and not defines and target != "host-clang"
    if folder is None:
        name = "-".join([target, optimization, *(Path(value).stem for _, value in defines)])
        folder = ROOT / "build" / (preset if plain else f"target/{name}")
    more = [f"-D{name}={value}" for name, value in defines]
    if not plain:
        more.append(f"-DCMAKE_C_FLAGS_RELWITHDEBINFO=-{optimization} -g")
        more.append(f"-DBELT_SMALL_START_UP={'ON' if optimization == 'O2' else 'OFF'}")
        if target in HOSTS:
            more += [f"-DCMAKE_C_COMPILER={HOSTS[target]}", "-DBELT_BUILD_TESTS=OFF"]
    # A folder's name says how it is configured; ninja sees what has changed since.
    if not (folder / "build.ninja").is_file():
        run(["cmake", "--preset", preset, "-B", folder, *more])
    run(["cmake", "--build", folder, "--target", *programs])
    return Build(target, folder)


def built(target):
    """The folder that `cmake --build --preset` fills."""
    return Build(target, ROOT / "build" / ("host" if target == "host" else target))


def shipped(pc):
    """The names of the shipped scenarios."""
    return [line.split()[0] for line in run([pc.folder / "belt_sim", "list"]).splitlines()]


@contextlib.contextmanager
def running(command, folder):
    """A program in a folder of its own; ended in any case."""
    with (folder / "messages").open("w") as messages:
        try:
            process = subprocess.Popen(
                command, cwd=folder, stdin=subprocess.DEVNULL, stdout=messages, stderr=messages
            )
        except FileNotFoundError:
            raise Failure(f"{command[0]} is not installed; tools/setup target brings it") from None
        try:
            yield process
        finally:
            process.kill()
            process.wait()


def simulate(simulator, server, folder, arguments):
    """The simulator with its controller behind two pipes: its exit code, and what was said."""
    for name in ("request", "reply"):
        (folder / name).unlink(missing_ok=True)
        os.mkfifo(folder / name)
    with running(server, folder) as board:
        remote = subprocess.Popen(
            [str(simulator), "run", *arguments],
            env=os.environ | {"BELT_REMOTE": str(folder)},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            end = time.monotonic() + HANG
            while remote.poll() is None and time.monotonic() < end:
                # A board that never came up leaves the simulator waiting at a pipe.
                if board.poll() is not None:
                    with contextlib.suppress(subprocess.TimeoutExpired):
                        remote.wait(5)
                    break
                with contextlib.suppress(subprocess.TimeoutExpired):
                    remote.wait(1)
        finally:
            remote.kill()
            message = remote.communicate()[1]
    return remote.returncode, message + (folder / "messages").read_text(encoding="utf-8")


def has_no_room(requests, build):
    """Whether a build refuses the first configuration of the requests, for its capacities."""
    with tempfile.TemporaryDirectory() as folder:
        first = requests[: 8 + 4 * int.from_bytes(requests[4:8], "little")]
        reply = replay(build.command("belt_server"), Path(folder), first)
    return int.from_bytes(reply[:4], "little") != 0


def replay(command, folder, requests, ends_with=0):
    """A server on recorded requests, to its end with that exit code: its replies, as bytes."""
    for name in ("request", "reply"):
        (folder / name).unlink(missing_ok=True)
    (folder / "request").write_bytes(requests)
    with running(command, folder) as board:
        try:
            code = board.wait(HANG)
        except subprocess.TimeoutExpired:
            raise Failure(f"{command[0]} did not end within {HANG} s") from None
    if code != ends_with:
        messages = (folder / "messages").read_text(encoding="utf-8")
        raise Failure(f"{' '.join(command)}: exit code {code}\n{messages}")
    return (folder / "reply").read_bytes()
