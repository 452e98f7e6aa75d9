# SPDX-License-Identifier: MIT
"""Every check of tools/checks passes a clean tree and fails on each planted violation."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]
LICENCE = "/* SPDX-License-Identifier: MIT */\n"
PYTHON_LICENCE = "# SPDX-License-Identifier: MIT\n"

CLEAN = {
    "firmware/belt/types.h": LICENCE + "#include <float.h>\ntypedef float belt_real_t;\n",
    "firmware/belt/observer.h": LICENCE + '#include "types.h"\nbelt_real_t belt_density(void);\n',
    "firmware/belt/observer.c": LICENCE
    + '#include "observer.h"\n\nbelt_real_t belt_density(void) {\n    return 1;\n}\n',
    "firmware/belt/belt.h": LICENCE + '#include "observer.h"\n',
    "host_sim/model.h": LICENCE + '#include "belt/belt.h"\n',
    "host_sim/plant.h": LICENCE + "double plant_level(void);\n",
    "host_sim/loop.c": LICENCE + '#include "belt/belt.h"\n#include "plant.h"\n#include <stdio.h>\n',
    "reference/line.py": PYTHON_LICENCE
    + "import math\n\nimport numpy as np\n\nLIMIT = np.float64(math.pi)\n",
}


def plant(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


@pytest.fixture
def root(tmp_path):
    plant(tmp_path, CLEAN)
    for name in (".clang-format", ".clang-tidy", "pyproject.toml"):
        shutil.copy(PROJECT / name, tmp_path)
    return tmp_path


def check(name: str, root: Path, *more: object) -> subprocess.CompletedProcess[str]:
    script = PROJECT / "tools" / "checks" / f"{name}.py"
    command = [sys.executable, script, "--root", root, *more]
    return subprocess.run(list(map(str, command)), capture_output=True, text=True)


CHECKS = [
    *("include_rules", "forbidden_words", "spdx", "format", "cppcheck"),
    *("misra", "clang_tidy", "gcc_analyzer", "complexity"),
]


@pytest.mark.parametrize("name", CHECKS)
def test_clean_tree_passes(root, name):
    result = check(name, root)
    assert result.returncode == 0, result.stdout + result.stderr


@pytest.mark.parametrize("name", CHECKS)
def test_tree_without_files_fails(tmp_path, name):
    assert check(name, tmp_path).returncode != 0


LEAK = """#include <stdlib.h>
int f(void);
int f(void) { char *p = malloc(8); if (p == NULL) { return 1; } p[0] = 1; return p[0]; }
"""
MANY_WAYS = "int f(int a);\nint f(int a) {\n" + 10 * "if (a > 3) { a -= 2; }\n" + "return a; }\n"

PLANTED = [
    # a stage knows one to its right, and one knows the wiring
    ("include_rules", "firmware/belt/observer.c", '#include "belt/predictor.h"\n'),
    ("include_rules", "firmware/belt/observer.c", '#include "gains.h"\n'),
    ("include_rules", "firmware/belt/observer.c", '#  include "belt.h"\n'),
    ("include_rules", "firmware/belt/config.h", '#include "line_model.h"\n'),
    ("include_rules", "firmware/belt/belt.c", '#include "snapshot.h"\n'),
    ("include_rules", "firmware/belt/observer.c", "#include <math.h>\n"),
    ("include_rules", "firmware/belt/observer.c", "#include USER_HEADER\n"),
    ("include_rules", "firmware/belt/observer.c", '#include "../../host_sim/plant.h"\n'),
    ("include_rules", "firmware/belt/helpers.h", "\n"),
    ("include_rules", "host_sim/plant.c", '#include "belt/belt.h"\n'),
    ("include_rules", "host_sim/plant.c", "#include <belt/belt.h>\n"),
    ("include_rules", "host_sim/plant.c", '#include "../firmware/belt/types.h"\n'),
    ("include_rules", "host_sim/plant.c", '#include "types.h"\n'),
    ("include_rules", "host_sim/plant.c", "#include SIM_LINE_LAWS\n"),
    ("include_rules", "host_sim/trace.c", '#include "model.h"\n'),
    ("include_rules", "host_sim/model.h", '#include "plant.h"\n'),
    ("include_rules", "host_sim/check.c", '#include "belt/config.h"\n'),
    ("include_rules", "reference/march.py", "from tools import demo_table\n"),
    ("include_rules", "reference/march.py", "def late():\n    import ctypes\n"),
    ("include_rules", "reference/march.py", "from .. import tests\n"),
    ("forbidden_words", "firmware/belt/observer.c", "double density;\n"),
    ("forbidden_words", "firmware/belt/observer.c", "#define WIDE (float)\n"),
    ("forbidden_words", "firmware/belt/observer.c", "void *p = malloc(8);\n"),
    ("forbidden_words", "firmware/belt/observer.c", "#include <stdlib.h>\n"),
    ("forbidden_words", "firmware/belt/observer.c", "int x = time(0);\n"),
    ("forbidden_words", "firmware/belt/observer.c", "int x = (int)sqrtf (2);\n"),
    ("forbidden_words", "firmware/belt/types.h", "int x = isnan(2);\n"),
    ("forbidden_words", "firmware/belt/observer.c", "void f(void) {\n#if X\n#endif\n}\n"),
    ("forbidden_words", "firmware/belt/observer.c", "void f(void) {\n  # ifdef X\n#endif\n}\n"),
    ("cppcheck", "firmware/belt/gains.c", "int f(void);\nint f(void) { int a[2]; return a[2]; }\n"),
    ("cppcheck", "host_sim/plant.c", "int f(int x);\nint f(int x) { return x / 0; }\n"),
    ("misra", "firmware/belt/gains.c", "int f(int a);\nint f(int a) { goto b;\nb: return a; }\n"),
    ("misra", "firmware/belt/gains.c", "int f(void);\nint f(void) { return 010; }\n"),
    (
        "clang_tidy",
        "firmware/belt/gains.c",
        "int f(int a);\nint f(int a) { if (a = 1) {} return a; }\n",
    ),
    ("clang_tidy", "host_sim/plant.c", "int f(int a);\nint f(int a) { return a ? 1 : 1; }\n"),
    ("gcc_analyzer", "host_sim/plant.c", LEAK),
    (
        "gcc_analyzer",
        "firmware/belt/gains.c",
        "int f(void);\nint f(void) { int *p = 0; return *p; }\n",
    ),
    ("complexity", "firmware/belt/gains.c", MANY_WAYS),
    ("complexity", "host_sim/plant.c", MANY_WAYS),
    ("format", "host_sim/plant.c", "int  f(void);\n"),
    ("format", "reference/march.py", "x = {  'a':1 }\n"),
    ("format", "reference/march.py", "import os\n"),
    ("format", "tools/march", "#!/usr/bin/env python3\nimport os\n"),
    ("format", "tools/march", "#!/usr/bin/env bash\necho $1\n"),
]


@pytest.mark.parametrize(("name", "file", "text"), PLANTED)
def test_planted_violation_is_found(root, name, file, text):
    licence = "" if text.startswith("#!") else LICENCE
    plant(root, {file: (PYTHON_LICENCE if file.endswith(".py") else licence) + text})
    result = check(name, root)
    assert result.returncode == 1, result.stdout + result.stderr
    assert Path(file).name in result.stdout + result.stderr


@pytest.mark.parametrize(
    ("entry", "status", "message"),
    [
        ("f firmware/belt/gains.c a table\n", 0, ""),
        ("f firmware/*\n    a table, on a line of its own\n", 0, ""),
        ("f firmware/belt/gains.c\n", 1, "no reason given"),
        ("g firmware/belt/gains.c a table\n", 1, "nothing deviates any more"),
        ("f host_sim/* a table\n", 1, "nothing deviates any more"),
    ],
)
def test_deviation_needs_a_reason_and_a_finding(root, entry, status, message):
    files = {
        "firmware/belt/gains.c": LICENCE + MANY_WAYS,
        "tools/checks/complexity_deviations.txt": "# " + LICENCE + entry,
    }
    plant(root, files)
    result = check("complexity", root)
    assert result.returncode == status, result.stdout + result.stderr
    assert message in result.stdout


@pytest.mark.parametrize(
    "file", ["a.c", "a.h", "a.py", "a.cmake", "sub/CMakeLists.txt", "tools/a", ".ci/run"]
)
def test_file_without_licence_is_found(root, file):
    plant(root, {file: "#!/usr/bin/env bash\n"})
    result = check("spdx", root)
    assert result.returncode == 1
    assert file in result.stdout


@pytest.mark.parametrize(
    "text",
    [
        "// double, malloc(), time\n/* float\n * sqrt(2) */\n",
        '#ifdef __cplusplus\nextern "C" {\n#endif\n#if X\n#endif\n',
        "int processing_time, round, time;\n",
        "#if A\nint f(void);\n#else\nint g(void);\n#endif\n",
    ],
)
def test_harmless_text_is_not_forbidden(root, text):
    plant(root, {"firmware/belt/observer.c": LICENCE + text})
    result = check("forbidden_words", root)
    assert result.returncode == 0, result.stdout


def library_of(folder: Path, code: str) -> Path:
    (folder / "planted.c").write_text(code, encoding="utf-8")
    subprocess.run(["gcc", "-fPIE", "-c", "planted.c"], cwd=folder, check=True)
    subprocess.run(["ar", "rcs", "libplanted.a", "planted.o"], cwd=folder, check=True)
    return folder / "libplanted.a"


@pytest.mark.parametrize(
    "code",
    [
        "int f(void) { static int calls; return ++calls; }",
        "int calls = 3;",
        "int f(void) { static _Thread_local int calls; return ++calls; }",
        "int calls __attribute__((common));",
    ],
)
def test_hidden_state_is_found(tmp_path, code):
    library = library_of(tmp_path, code)
    assert check("no_statics", tmp_path, "--library", library).returncode == 1


def test_constants_are_not_state(tmp_path):
    code = 'const int a[2] = {1, 2};\nconst char *const b[2] = {"x", "y"};\n'
    library = library_of(tmp_path, code)
    result = check("no_statics", tmp_path, "--library", library)
    assert result.returncode == 0, result.stdout


GOOD_EXAMPLE = "```c\n/* readme_example */\nint f(void);\nint main(void) { return f(); }\n```\n"


@pytest.mark.parametrize(
    ("readme", "status"),
    [
        (GOOD_EXAMPLE, 0),
        ("```c\nint main(void) { return 1; }\n```\n" + GOOD_EXAMPLE, 0),
        (GOOD_EXAMPLE.replace("f()", "f() + 1"), 1),
        (GOOD_EXAMPLE.replace("f()", "f(1)"), 1),
        (GOOD_EXAMPLE.replace("return", "int unused; return"), 1),
        (GOOD_EXAMPLE.replace("readme_example", "another"), 1),
        (GOOD_EXAMPLE.replace("```c", "```sh"), 1),
        ("", 1),
        (None, 1),
    ],
)
def test_readme_example_must_stand_compile_and_run(tmp_path, readme, status):
    library = library_of(tmp_path, "int f(void) { return 0; }")
    if readme is not None:
        plant(tmp_path, {"README.md": readme})
    result = check(
        *("readme_example", tmp_path, "--library", library, "--work-dir", tmp_path),
        *("--", "gcc", "-std=c99", "-Wall", "-Wextra", "-Werror"),
    )
    assert result.returncode == status, result.stdout + result.stderr
