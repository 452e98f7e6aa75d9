# SPDX-License-Identifier: MIT
"""Words that the firmware does without: heap, I/O, clock, libm, and the number types' own names."""

import re
from collections.abc import Iterator
from pathlib import Path

import tree

# The whole words. Comments and strings do not count.
WORDS = {
    "stdio": "no I/O",
    "stdlib": "no standard library",
    "malloc calloc realloc alloca free": "no heap",
    "printf fprintf sprintf snprintf puts putchar FILE stdout stderr": "no I/O",
    "exit abort atexit system getenv": "no way out of the caller's hands",
    "time_t clock_t gettimeofday clock_gettime": "no clock: the period is passed in",
    "errno setjmp longjmp signal": "no state of the C library",
    "assert": "BELT_ASSERT instead: the user decides what it does",
    "math tgmath fenv complex": "no libm",
}
# Where they are called: libm's functions with their f and l forms, and the clock's.
LIBM = """
acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs
fdim floor fma fmax fmin fmod frexp hypot ilogb ldexp lgamma llrint llround log log10 log1p log2
logb lrint lround modf nan nearbyint nextafter nexttoward pow remainder remquo rint round scalbln
scalbn sin sinh sqrt tan tanh tgamma trunc fpclassify isfinite isinf isnan isnormal signbit
"""

WORD_REASONS = {word: reason for words, reason in WORDS.items() for word in words.split()}
ANY_WORD = re.compile(r"\b[A-Za-z_]\w*\b")
CLOCK_CALL = re.compile(r"\b(?:time|clock)\s*\(")
LIBM_CALL = re.compile(rf"\b(?:{'|'.join(LIBM.split())})[fl]?\s*\(")
NUMBER_TYPE = re.compile(r"\b(?:float|double)\b")
CONDITION = re.compile(r"^\s*#\s*(?:if|ifdef|ifndef|elif|else)\b")
CPLUSPLUS_GUARD = re.compile(
    r"^[ \t]*#[ \t]*ifdef __cplusplus\b.*?^[ \t]*#[ \t]*endif", re.MULTILINE | re.DOTALL
)


def in_line(line: str, may_name_number_types: bool) -> Iterator[str]:
    if not re.match(r"\s*#\s*include\s*<float\.h>", line):
        if not may_name_number_types and (match := NUMBER_TYPE.search(line)):
            yield f"{match[0]}: belt_real_t instead"
        for match in ANY_WORD.finditer(line):
            if match[0] in WORD_REASONS:
                yield f"{match[0]}: {WORD_REASONS[match[0]]}"
    if CLOCK_CALL.search(line):
        yield "no clock: the period is passed in"
    if match := LIBM_CALL.search(line):
        yield f"{match[0]}): no libm"


def in_file(root: Path, path: Path) -> Iterator[str]:
    where = path.relative_to(root)
    text = tree.without_comments(path.read_text(encoding="utf-8"))
    text = CPLUSPLUS_GUARD.sub(lambda match: "\n" * match[0].count("\n"), text)
    depth = 0
    continued = False
    for number, line in enumerate(text.splitlines(), start=1):
        for fault in in_line(line, path.name == "types.h"):
            yield f"{where}:{number}: {fault}"
        if depth > 0 and CONDITION.match(line):
            yield f"{where}:{number}: a condition of the preprocessor inside braces"
        is_directive = continued or line.lstrip().startswith("#")
        continued = is_directive and line.endswith("\\")
        if not is_directive:
            depth += line.count("{") - line.count("}")


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    paths = [path for path in tree.files(root, "firmware/belt") if tree.is_c(path)]
    return tree.report([fault for path in paths for fault in in_file(root, path)], len(paths))


if __name__ == "__main__":
    tree.run(main)
