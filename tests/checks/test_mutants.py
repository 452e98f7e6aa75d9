# SPDX-License-Identifier: MIT
"""Which changes tools/mutate makes to a source, and which not."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))

from mutation.mutants import mutants_of  # noqa: E402

BODY = "int f(int a) {\n    %s\n}\n"


def changes(text):
    return {mutant.after for mutant in mutants_of("f.c", text)}


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        ("return a + b;", {"return a - b;"}),
        ("return -a;", {"return a;"}),
        ("return a < b;", {"return a <= b;", "return a >= b;"}),
        ("return a && b;", {"return a || b;"}),
        ("return a[1u];", {"return a[2u];", "return a[0u];"}),
        ("return BELT_REAL(0.5);", {"return BELT_REAL(0);", "return BELT_REAL(1.0);"}),
        ("return 0x10u;", {"return 0x11u;", "return 0xfu;"}),
        ("a->b = c;", {";"}),
        ("a += b;", {"a -= b;", ";"}),
        ("if (a) { return b; }", {"if (!(a)) { return b; }"}),
        ("return (a) ? b : c;", {"return !((a)) ? b : c;"}),
        ("return a->b ? c : d;", {"return !(a->b) ? c : d;"}),
        ("return (belt_real_t)-a;", {"return (belt_real_t)a;"}),
        # what stays
        ("const belt_line_t *line = a;", set()),
        ("BELT_ASSERT(a != NULL);", set()),
        ("return sizeof *a;", set()),
        ('/* a + b */ return "a + b";', set()),
    ],
)
def test_changes_of_a_statement(statement, expected):
    assert changes(BODY % statement) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#define LIMIT 3u\n", {"#define LIMIT 4u", "#define LIMIT 2u"}),
        ("#define A_CAPACITY 3u\n", set()),
        ("#define WRAP(a) ((a) + 3u)\n", set()),
        ("#include <float.h>\n#if A > 3\n#endif\n", set()),
        ("typedef struct {\n    int a[3 + 1];\n} t;\nint f(int a);\n", set()),
        ("BELT_STATIC_ASSERT(name, 3 > 2);\n", set()),
        ("static const int a[2] = {0, 7};\n", {"{1, 7}", "{0, 8}", "{0, 6}"}),
    ],
)
def test_changes_outside_of_functions(text, expected):
    found = {after.removeprefix("static const int a[2] = ").rstrip(";") for after in changes(text)}
    assert found == expected


def test_rows_of_a_table_get_the_next_word_of_their_column():
    table = "#define TABLE(row) \\\n    row(A, X, P) \\\n    row(B, Y, Q)\n"
    assert changes(table) == {"row(A, Y, P) \\", "row(A, X, Q) \\", "row(B, X, Q)", "row(B, Y, P)"}


def test_an_id_stays_when_other_lines_come_and_go():
    text = BODY % "return a + b;"
    moved = "int g(void);\n\n" + text
    assert [m.id for m in mutants_of("f.c", text)] == [m.id for m in mutants_of("f.c", moved)]
    assert [m.line + 2 for m in mutants_of("f.c", text)] == [
        m.line for m in mutants_of("f.c", moved)
    ]


def test_the_same_change_made_twice_has_two_ids():
    mutants = list(mutants_of("f.c", BODY % "a += b;\n    a += b;"))
    assert len({mutant.id for mutant in mutants}) == len(mutants) == 4
