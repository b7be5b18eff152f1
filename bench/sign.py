#!/usr/bin/env python3
"""Writes into what bench/study or bench/stability has found on which machine that was:

    bench/sign.py FILE [--machine NAME]

bench/run draws it on the page of a run that may come from another one.
"""
from __future__ import annotations

import json
import platform
from pathlib import Path

from command_line import BadInput, Parser, run_main
from machine import cpu
from stored_run import parse_json, read_text


def sign(path: Path, machine: str) -> None:
    """Name and CPU come first; the program has written commit and instruction set."""
    data = parse_json(read_text(path), str(path))
    if not isinstance(data, dict):
        raise BadInput(f"{path}: must hold an object")
    signed = {"machine": machine, "cpu": cpu(), **data}
    path.write_text(json.dumps(signed, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def main() -> int:
    parser = Parser(prog="bench/sign.py", description="Writes into a result on which machine it was found.")
    parser.add_argument("file", type=Path, metavar="FILE", help="study.json or stability.json")
    parser.add_argument("--machine", default=platform.node(), help="the machine's name (default: its host name)")
    given = parser.parse_args()
    sign(given.file, given.machine)
    return 0


if __name__ == "__main__":
    run_main(main)
