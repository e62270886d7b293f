#!/usr/bin/env python3
"""Makes the tables of README.md and docs/machine.md again, of the archived results that comments name.

usage: readme.py PTBENCH

A table stands under `<!-- table: VENDOR/DEVICE/RUN -->`, and keeps the columns that it has; cases with explicit
work-groups are left out. With `+ 2016`, the fastest row of the thesis' table comes first. Under `<!-- board -->` stands the
first ranking of the archive's page."""

import html
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCUMENTS = (ROOT / "README.md", ROOT / "docs/machine.md")
BOARD = re.compile(r"(<!-- board -->\n\n(?:\|.*\n){2})((?:\|.*\n)+)")
TABLE = re.compile(r"(<!-- table: (\S+)( \+ 2016)? -->\n\n)((?:\|.*\n)+)")


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def times(ptbench, run):
    """Rows of the first table of the run's Markdown, by their columns."""
    file = ROOT / "results/archive" / run / "result.json"
    shown = subprocess.run([ptbench, "report", file, "--md", "-"], capture_output=True, text=True, check=True).stdout
    lines = re.search(r"(?:^\|.*\n)+", shown, re.M).group().splitlines()
    return [dict(zip(cells(lines[0]), cells(line))) for line in lines[2:]]


def fastest_published():
    table = json.loads((ROOT / "results/thesis-2016.json").read_text(encoding="utf-8"))
    most = max(row["spp"] for row in table["rows"])
    row = min((row for row in table["rows"] if row["spp"] == most), key=lambda row: row["time_ms"])
    width, height = map(int, row["size"].split("x"))
    rate = width * height * row["spp"] / row["time_ms"] / 1e3
    return {"vendor": row["vendor"], "type": row["type"], "device": f"{row['device']} ({table['year']})",
            "SPP": str(row["spp"]), "time ms": f"{row['time_ms']:.0f}", "kernel": table["kernel"], "size": row["size"],
            "Msamples/s": f"{rate:.3f}"}


def table_again(ptbench, match):
    """The text of a table, made anew under its own columns."""
    comment, run, with_2016, old = match.groups()
    head, rule = old.splitlines()[:2]
    rows = [row for row in times(ptbench, run) if row["work-group"] == "implicit"]
    if with_2016:
        rows.insert(0, fastest_published())
    lines = [head, rule] + ["| " + " | ".join(row.get(title, "-") for title in cells(head)) + " |" for row in rows]
    return comment + "".join(line + "\n" for line in lines)


def plain(cell):
    return html.unescape(re.sub(r"<small>.*?</small>|<.*?>", "", cell)).strip()


def board_rows():
    """Of the first ranking in the archive's page: place, device, value and how it was measured. Of several equal devices that
    were measured together, which have their keys there, none."""
    page = (ROOT / "results/archive/index.html").read_text(encoding="utf-8")
    table = re.search(r'<table class="board">.*?</table>', page, re.S).group()
    rows = [[plain(cell) for cell in re.split(r"<td[^>]*>", row)[2:]] for row in re.findall(r"<tr><td.*?</tr>", table)]
    alone = [row for row in rows if not row[0].startswith("[")]
    return [[str(place), device, value, how] for place, (device, _, value, how) in enumerate(alone, 1)]


def board_again(match):
    return match[1] + "".join(f"| {' | '.join(row)} |\n" for row in board_rows())


def main(ptbench):
    for document in DOCUMENTS:
        text = TABLE.sub(lambda match: table_again(ptbench, match), document.read_text(encoding="utf-8"))
        document.write_text(BOARD.sub(board_again, text), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
