# SPDX-License-Identifier: MIT
"""Builds mutants of the firmware and holds them against the unit tests, and against whole runs.

The unit tests run in the three builds of tools/test: float32, double, and float32 under the
sanitizers; a mutant that one of them notices is killed. All work is done on a copy of the sources,
so that a long campaign and an editor do not meet. Objects are compiled once; of a mutant only what
includes the changed file is compiled again.
"""

import hashlib
import json
import shutil
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from mutation.mutants import Mutant

FLAGS = ["-std=c99", "-ffp-contract=off", "-w", "-fno-pie", "-DUNITY_INCLUDE_DOUBLE"]
BUILDS = {
    "float32": ["-O1"],
    "double": ["-O1", "-DBELT_REAL_IS_DOUBLE=1"],
    "sanitize": ["-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"],
}
PROVING_BUILDS = ["float32", "double"]
PROVING_LEVELS = ["-O2", "-O3"]  # equal object code at one of them: the mutant is the same program
CPU_SECONDS = 10  # and ten times what the unmutated program takes: a loop without end
LIBRARIES = ["-linih", "-lm"]
MORE_RUNS = [
    ["paper", "controller.law=frozen"],
    ["heavy_window", "controller.law=frozen"],
    ["paper", "controller.density=measured"],
    ["paper", "controller.outlet_flux=measured"],
    ["lossy_profile", "controller.outlet_flux=measured"],
    ["paper", "controller.node_count=41"],
]


class Failure(Exception):
    """The unmutated sources do not build or do not pass; the text says which."""


def fingerprint(root: Path) -> str:
    """Of all a result hangs on: sources, tests, compiler, how mutants are made and judged."""
    digest = hashlib.sha256()
    for folder in ("firmware/belt", "host_sim", "tests/unit", "tools/mutation", "build/unity/src"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in {".c", ".h", ".ini", ".py"}:
                digest.update(str(path.relative_to(root)).encode() + path.read_bytes())
    digest.update((root / "CMakePresets.json").read_bytes())
    digest.update(run(["gcc", "--version"], check=True).stdout)
    return digest.hexdigest()[:16]


def capacities(root: Path) -> list[str]:
    presets = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
    base = next(p for p in presets["configurePresets"] if p["name"] == "base")
    values = base["cacheVariables"]
    return [f"-D{name}={value}" for name, value in values.items() if name.endswith("_CAPACITY")]


def run(command: list, **more) -> subprocess.CompletedProcess:
    return subprocess.run(list(map(str, command)), capture_output=True, **more)


def archive(parts: list[Path], library: Path) -> Path:
    """A library: of what a program brings itself nothing is taken from it."""
    library.unlink(missing_ok=True)
    run(["ar", "rcs", library, *parts], check=True)
    return library


class Sources:
    """A copy of all that is compiled."""

    def __init__(self, root: Path, folder: Path):
        shutil.rmtree(folder, ignore_errors=True)
        for part in ("firmware", "host_sim", "tests/unit", "build/unity/src"):
            shutil.copytree(root / part, folder / part)
        self.include = folder / "firmware"
        self.belt = folder / "firmware" / "belt"
        self.firmware = sorted(self.belt.glob("*.c"))
        self.tests = sorted((folder / "tests" / "unit").glob("test_*.c"))
        self.host = sorted((folder / "host_sim").glob("*.c"))
        self.unity = folder / "build" / "unity" / "src" / "unity.c"
        self.scenarios = sorted((folder / "host_sim" / "scenarios").glob("*.ini"))
        self.options = [
            *FLAGS,
            *capacities(root),
            f'-DBELT_SIM_SCENARIO_DIR="{folder / "host_sim" / "scenarios"}"',
            *("-I", folder / "host_sim", "-I", folder / "build" / "unity" / "src"),
        ]

    def every(self) -> list[Path]:
        return [*self.firmware, *self.tests, *self.host, self.unity]


class Build:
    """The unmutated programs in one of the three builds."""

    def __init__(self, name: str, sources: Sources, work: Path):
        self.name = name
        self.sources = sources
        self.options = BUILDS[name]
        self.objects = work / "objects" / name
        shutil.rmtree(self.objects, ignore_errors=True)
        self.objects.mkdir(parents=True)
        self.includes: dict[Path, set[str]] = {}
        self.cpu_seconds: dict[Path, int] = {}
        self.order: list[Path] = []

    def command(self, source: Path, include: Path, options: list[str]) -> list:
        return ["gcc", *options, *self.sources.options, "-I", include, "-c", source]

    def compile(self, source: Path, output: Path, include: Path) -> bool:
        command = self.command(source, include, self.options)
        return run([*command, "-o", output]).returncode == 0

    def compile_unmutated(self, source: Path) -> None:
        output = self.objects / f"{source.stem}.o"
        command = self.command(source, self.sources.include, self.options)
        result = run([*command, "-MMD", "-MF", output.with_suffix(".d"), "-o", output], text=True)
        if result.returncode != 0:
            raise Failure(f"{source.name} does not compile:\n{result.stderr}")
        words = output.with_suffix(".d").read_text(encoding="utf-8").replace("\\\n", " ").split()
        self.includes[source] = {Path(word).name for word in words if "/firmware/belt/" in word}

    def link(self, parts: list[Path], program: Path) -> bool:
        command = ["gcc", *self.options, "-no-pie", *parts, *LIBRARIES, "-o", program]
        return run(command).returncode == 0

    def prepare(self, pool: ThreadPoolExecutor) -> None:
        """The unmutated tests must pass; the quick ones come first."""
        list(pool.map(self.compile_unmutated, self.sources.every()))
        self.belt = [self.objects / f"{source.stem}.o" for source in self.sources.firmware]
        self.unity = self.objects / "unity.o"
        host = [self.objects / f"{p.stem}.o" for p in self.sources.host if p.stem != "main"]
        self.host_library = archive(host, self.objects / "libhost.a")
        self.belt_library = archive(self.belt, self.objects / "libbelt.a")
        taken = {}
        for test in self.sources.tests:
            program = self.objects / test.stem
            parts = [self.objects / f"{test.stem}.o", self.unity]
            start = time.monotonic()
            if not self.link([*parts, self.host_library, self.belt_library], program) or (
                run([program], cwd=self.objects).returncode != 0
            ):
                raise Failure(f"{test.stem} does not pass without any mutant ({self.name})")
            taken[test] = time.monotonic() - start
            self.cpu_seconds[test] = CPU_SECONDS + round(10 * taken[test])
        self.order = sorted(taken, key=taken.get)


class Bench:
    """What all workers share."""

    def __init__(self, root: Path, work: Path, jobs: int, needs_runs: bool):
        self.work = work
        self.sources = Sources(root, work / "tree")
        self.builds = {name: Build(name, self.sources, work) for name in BUILDS}
        with ThreadPoolExecutor(max_workers=jobs) as pool:
            for build in self.builds.values():
                build.prepare(pool)
        self.lock = threading.Lock()
        self.killers: dict[str, Path] = {}
        self.proofs: dict[tuple, bytes] = {}
        if needs_runs:
            build = self.builds["float32"]
            program = build.objects / "belt_sim"
            parts = [build.objects / "main.o", build.host_library, build.belt_library]
            if not build.link(parts, program):
                raise Failure("belt_sim does not link")
            self.expected = [self.outcome(program, run) for run in self.runs()]

    def tests_for(self, build: Build, file: str) -> list[Path]:
        """The unit tests: first the one that killed a mutant of this file last, then its own."""
        own = f"test_{Path(file).stem}"
        with self.lock:
            killer = self.killers.get(file)
        return sorted(build.order, key=lambda t: (t != killer, not t.stem.startswith(own)))

    def runs(self) -> list[list[str]]:
        settings = [[name, "--set", setting] for name, setting in MORE_RUNS]
        return [[path.stem] for path in self.sources.scenarios] + settings

    def outcome(self, program: Path, words: list[str]) -> bytes:
        """Everything a run puts out: status, summary, trace."""
        trace = program.with_suffix(".csv")
        trace.unlink(missing_ok=True)
        command = ["prlimit", f"--cpu={60 * CPU_SECONDS}", program, "run", *words]
        result = run([*command, "--trace", trace], cwd=program.parent)
        written = trace.read_bytes() if trace.is_file() else b""
        content = b"%d\n%s\n%s" % (result.returncode, result.stdout, written)
        return hashlib.sha256(content).digest()

    def unmutated_code(self, build: Build, source: Path, level: str, folder: Path) -> bytes:
        key = (build.name, source.name, level)
        if key not in self.proofs:
            command = build.command(source, self.sources.include, [*build.options, level])
            output = folder / "unmutated.o"
            run([*command, "-o", output], check=True)
            self.proofs[key] = output.read_bytes()
        return self.proofs[key]


class Worker:
    """One mutant at a time, in a copy of the firmware of its own."""

    def __init__(self, bench: Bench, index: int):
        self.bench = bench
        self.folder = bench.work / f"worker_{index}"
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(bench.sources.include, self.folder / "firmware")
        self.include = self.folder / "firmware"

    def compile(self, build: Build, source: Path, file: str) -> Path | None:
        """Object of a source, compiled anew where it sees the changed file."""
        if file not in build.includes[source]:
            return build.objects / f"{source.stem}.o"
        output = self.folder / f"{source.stem}.o"
        changed = source
        if source in self.bench.sources.firmware:
            changed = self.include / "belt" / source.name
        return output if build.compile(changed, output, self.include) else None

    def library(self, build: Build, file: str) -> Path | None:
        """The firmware with the mutant in it; None when it does not compile."""
        parts = [self.compile(build, source, file) for source in self.bench.sources.firmware]
        return None if None in parts else archive(parts, self.folder / "libbelt.a")

    def against_build(self, build: Build, file: str) -> str:
        belt = self.library(build, file)
        if belt is None:
            return "unbuilt"
        program = self.folder / "program"
        for test in self.bench.tests_for(build, file):
            part = self.compile(build, test, file)
            if part is None or not build.link(
                [part, build.unity, build.host_library, belt], program
            ):
                return "unbuilt"
            command = ["prlimit", f"--cpu={build.cpu_seconds[test]}", program]
            if run(command, cwd=self.folder).returncode != 0:
                with self.bench.lock:
                    self.bench.killers[file] = test
                return "killed"
        return "survived"

    def against_tests(self, mutant: Mutant) -> str:
        """killed, survived, equivalent, or unbuilt."""
        for build in self.bench.builds.values():
            result = self.against_build(build, mutant.file)
            if result != "survived":
                return result
            if build.name == "float32" and self.is_same_program(mutant.file):
                return "equivalent"
        return "survived"

    def is_same_program(self, file: str) -> bool:
        """Whether the compiler makes the same object code of every source that sees the change."""
        return all(
            any(self.is_same_code(self.bench.builds[name], file, level) for level in PROVING_LEVELS)
            for name in PROVING_BUILDS
        )

    def is_same_code(self, build: Build, file: str, level: str) -> bool:
        output = self.folder / "mutant.o"
        for source in self.bench.sources.firmware:
            if file not in build.includes[source]:
                continue
            changed = self.include / "belt" / source.name
            command = build.command(changed, self.include, [*build.options, level])
            if run([*command, "-o", output]).returncode != 0:
                return False
            expected = self.bench.unmutated_code(build, source, level, self.folder)
            if output.read_bytes() != expected:
                return False
        return True

    def against_runs(self, mutant: Mutant) -> str:
        """killed when one run puts out one other bit, else survived."""
        build = self.bench.builds["float32"]
        belt = self.library(build, mutant.file)
        host = [self.compile(build, source, mutant.file) for source in self.bench.sources.host]
        program = self.folder / "belt_sim"
        if belt is None or None in host or not build.link([*host, belt], program):
            return "unbuilt"
        for words, expected in zip(self.bench.runs(), self.bench.expected):
            if self.bench.outcome(program, words) != expected:
                return "killed"
        return "survived"

    def judge(self, mutant: Mutant, stage: str) -> str:
        original = self.bench.sources.belt / mutant.file
        changed = self.include / "belt" / mutant.file
        text = mutant.apply(original.read_text(encoding="utf-8"))
        changed.write_text(text, encoding="utf-8")
        try:
            return self.against_tests(mutant) if stage == "tests" else self.against_runs(mutant)
        finally:
            shutil.copy(original, changed)
