# SPDX-License-Identifier: MIT
"""What tools/cost has found, as rows on a terminal and as tables on the pages that show it."""

import board

COST = board.ROOT / "docs" / "COST.md"
README = board.ROOT / "README.md"
SHOWN_FIRST = (20, ("law", "full"))  # the README's rows: nodes and modes

COLUMNS = {
    "target": "target",
    "node_count": "nodes",
    "mode": "mode",
    "instructions_min": "least",
    "instructions_max": "greatest",
    "path": "path",
    "cycles_max": "cycles",
    "flash": "flash",
    "ram": "RAM",
    "stack": "stack",
}
FORMAT = "{:<12}{:>6}  {:<8}{:>9}{:>10}{:>8}{:>8}{:>8}{:>7}{:>7}"


def heading():
    above = FORMAT.format("", "", "", "instruc", "tions", *[""] * 5).rstrip()
    return f"{above}\n{FORMAT.format(*COLUMNS.values())}"


def line(row):
    return FORMAT.format(*(row.get(name, "-") for name in COLUMNS))


def markdown(head, rows):
    cells = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(map(str, row))} |\n" for row in cells)


def costs(rows):
    return markdown(
        list(COLUMNS.values()), [[row.get(name, "") for name in COLUMNS] for row in rows]
    )


def estimates(rows):
    """Cycles by the manual's counts."""
    head = ["nodes", "mode", "greatest", "cycles", "cycles an instruction", "path", "its cycles"]
    names = ["node_count", "mode", "instructions_max", "estimate", "", "path", "path_estimate"]
    found = []
    for row in rows:
        if "estimate" in row:
            ratio = {"": f"{row['estimate'] / row['instructions_max']:.2f}"}
            found.append([(row | ratio)[name] for name in names])
    return markdown(head, found)


def flash_parts(flash):
    objects = sorted(flash["objects"].items(), key=lambda item: -item[1])
    rows = [[f"`{name}.c`", size] for name, size in objects if size]
    rows.append(["all calls of `belt.h`", sum(flash["objects"].values())])
    rows += [
        [f"`{name}`, where used", f"+{flash[name]}"] for name in ("snapshot.h", "belt_status_name")
    ]
    return markdown(["part", "bytes"], rows)


def put(path, name, table):
    """Puts a table between its two marks of a page."""
    begin, end = (f"<!-- tools/cost: {name} {word} -->\n" for word in ("begin", "end"))
    before, found, rest = path.read_text(encoding="utf-8").partition(begin)
    _, found_end, after = rest.partition(end)
    if not found or not found_end:
        raise board.Failure(f"{path.name} has no marks around its table: {name}")
    path.write_text(before + begin + table + end + after, encoding="utf-8")


def write(rows, flash):
    nodes, modes = SHOWN_FIRST
    put(COST, "costs", costs(rows))
    put(COST, "estimates", estimates(rows))
    put(COST, "flash", flash_parts(flash))
    put(
        README,
        "costs",
        costs([row for row in rows if row["node_count"] == nodes and row["mode"] in modes]),
    )
