# SPDX-License-Identifier: MIT
"""cppcheck finds nothing in the firmware and the simulator."""

import subprocess

import tree

OPTIONS = [
    "--quiet",
    "--std=c99",
    "--enable=warning,style,performance,portability",
    "--inline-suppr",
    "-UBELT_LINE_LAWS",  # headers that a build may name; here both sides have their own
    "-USIM_LINE_LAWS",
    "--error-exitcode=1",
    "--suppress=missingIncludeSystem",
    # cppcheck 2.10 splits a macro's argument at the commas that its expansion holds; gcc is right.
    "--suppress=preprocessorErrorDirective:host_sim/scenario_keys.c",
    "--template={file}:{line}: {id}: {message}",
]


def main(argv: list[str]) -> int:
    root = tree.arguments(__doc__).parse_args(argv).root
    paths = [path for path in tree.files(root, "firmware", "host_sim") if path.suffix == ".c"]
    names = [str(path.relative_to(root)) for path in paths]
    command = ["cppcheck", *OPTIONS, "-I", "firmware", "-I", "host_sim", *names]
    status = subprocess.run(command, cwd=root).returncode if paths else 0
    return tree.report(["cppcheck: see above"] if status else [], len(paths))


if __name__ == "__main__":
    tree.run(main)
