# SPDX-License-Identifier: MIT
"""The library in somebody else's build: as a folder, fetched, installed, and as two files."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PARTS = ROOT / "tools" / "target"

HEAD = "cmake_minimum_required(VERSION 3.22)\nproject(user C)\n"
TAIL = "add_executable(user main.c)\ntarget_link_libraries(user PRIVATE belt::belt)\n"
WAYS = {
    "folder": f'add_subdirectory("{ROOT}" forebelt)\n',
    "fetched": "include(FetchContent)\n"
    f'FetchContent_Declare(forebelt SOURCE_DIR "{ROOT}")\nFetchContent_MakeAvailable(forebelt)\n',
    "installed": "find_package(belt 0.1 REQUIRED)\n",
}


def run(*command, cwd=None):
    result = subprocess.run(list(map(str, command)), cwd=cwd, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


def readme_program():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    return re.search(r"```c\n(/\* readme_example \*/\n.*?)```", text, re.DOTALL)[1]


@pytest.mark.parametrize("way", WAYS)
def test_user_builds_with_cmake(way, tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(HEAD + WAYS[way] + TAIL)
    (tmp_path / "main.c").write_text(readme_program())
    options = []
    if way == "installed":
        own, prefix = tmp_path / "own", tmp_path / "prefix"
        alone = ["-DBELT_BUILD_HOST=OFF", "-DBELT_BUILD_TESTS=OFF", "-DBELT_BUILD_TARGET=OFF"]
        run("cmake", "-S", ROOT, "-B", own, "-G", "Ninja", *alone)
        run("cmake", "--build", own)
        run("cmake", "--install", own, "--prefix", prefix)
        options = [f"-DCMAKE_PREFIX_PATH={prefix}"]
    build = tmp_path / "build"
    run("cmake", "-S", tmp_path, "-B", build, "-G", "Ninja", *options)
    run("cmake", "--build", build)
    run(build / "user")


def answers(folder, requests, *sources):
    """The replies of a server on the PC, built from these sources of the library."""
    folder.mkdir(exist_ok=True)
    parts = [PARTS / name for name in ("server.c", "exchange.c", "channel.c", "channel_posix.c")]
    strict = ["-std=c99", "-O2", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    run("cc", *strict, "-I", folder, "-I", PARTS, "-o", folder / "server", *parts, *sources)
    (folder / "request").write_bytes(requests)
    run(folder / "server", cwd=folder)
    return (folder / "reply").read_bytes()


def test_two_files_are_the_library(tmp_path):
    source, two = ROOT / "firmware" / "belt", tmp_path / "two"
    run(ROOT / "tools" / "amalgamate", source, two / "belt")
    assert sorted(path.name for path in (two / "belt").iterdir()) == ["belt.c", "belt.h"]
    (two / "belt" / "snapshot.h").write_text('#include "belt.h"\n')  # for the server alone
    requests = (Path(__file__).parent / "worst" / "cortex-m4f_20_full.requests").read_bytes()
    many = tmp_path / "many"
    many.mkdir()
    (many / "belt").symlink_to(source)
    found = answers(two, requests, two / "belt" / "belt.c")
    assert found == answers(many, requests, *source.glob("*.c"))
    assert len(found) > 1000


def test_preset_has_a_target_for_the_two_files():
    run("cmake", "--build", ROOT / "build" / "host", "--target", "belt_amalgamation")
    made = ROOT / "build" / "host" / "amalgamation"
    assert (made / "belt.h").is_file() and (made / "belt.c").is_file()
