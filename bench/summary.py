#!/usr/bin/env python3
"""Prints a stored run in short: run time of each case beside the paper's.

    bench/summary.py RUN
"""
from __future__ import annotations

from pathlib import Path

from command_line import Parser, run_main
from page.cases import run_time
from page.figure import Cell
from paper_times import MACHINE
from stored_run import Run, read_run
from text import number, table


def words(cell: Cell) -> str:
    """A number for people, a dash for none."""
    return "-" if cell is None else number(cell) if isinstance(cell, float) else str(cell)


def summary(run: Run) -> str:
    """Cases with one thread and the best with more; else how many other benchmarks the run holds."""
    rows = []
    for case, single, more, threads, paper, ratio, _ in run_time(run).rows:
        rows.append([str(case), words(single), words(more), words(threads), words(paper),
                     f"{words(ratio)} times faster" if ratio else ""])
    if not rows:
        return f"{len(run.results)} benchmarks, none of them a case: the page and the exports have their figures"
    headers = ["minutes per simulated second", "1 thread", "more threads", "how many", "paper", ""]
    return table(headers, rows) + f"\nthe paper's: {MACHINE}"


def main() -> int:
    parser = Parser(prog="bench/summary.py", description="Prints a stored run in short.")
    parser.add_argument("run", type=Path, metavar="RUN", help="stored run: Google Benchmark's JSON")
    run = read_run(parser.parse_args().run)
    print(summary(run))
    return 0


if __name__ == "__main__":
    run_main(main)
