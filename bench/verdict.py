#!/usr/bin/env python3
"""Says what went wrong in a stored run, as its exit code does:

    bench/verdict.py RUN

Exit codes: 0 nothing, 1 a benchmark gave up, 5 a scene came to different bits, 2 bad input. Bits weigh more.
"""
from __future__ import annotations

import sys
from pathlib import Path

from command_line import Parser, run_main
from page import bits
from stored_run import Run, read_run

GAVE_UP, DIFFERENT = 1, 5


def verdict(run: Run) -> tuple[int, list[str]]:
    """Exit code and a sentence for each thing that went wrong."""
    gave_up = [f"{result.name} gave up: {result.error}" for result in run.results.values() if result.error]
    different = bits.differences(run)
    return DIFFERENT if different else GAVE_UP if gave_up else 0, [*different, *gave_up]


def main() -> int:
    parser = Parser(prog="bench/verdict.py", description="Says what went wrong in a stored run.",
                    epilog="Exit codes: 0 nothing, 1 a benchmark gave up, 5 a scene came to different bits, "
                           "2 bad input.")
    parser.add_argument("run", type=Path, metavar="RUN", help="stored run: Google Benchmark's JSON")
    code, sentences = verdict(read_run(parser.parse_args().run))
    for sentence in sentences:
        print(f"error: {sentence}", file=sys.stderr)
    return code


if __name__ == "__main__":
    run_main(main)
