#!/usr/bin/env python3
"""The history of runs: one JSON line for each benchmark of each run, only ever appended to.

    bench/history.py HISTORY RUN...     adds stored runs; a run that is there already is left alone

A line holds all that is needed to draw and compare it, so a history outlives the runs it was made from and those of
several machines can be put together with `cat`.
"""
from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from command_line import BadInput, Parser, run_main
from stored_run import Result, Run, parse_json, read_run, read_text, utc

SCHEMA = 1

Record = dict[str, Any]


def record(run: Run, result: Result) -> Record:
    """One line of the history. Times are seconds per iteration of the benchmark, by the clock that it goes by; they
    were all of the wall when real_time_s got its name."""
    return {
        "schema": SCHEMA,
        "run": run.id,
        "date": run.date,
        "commit": run.about("commit"),
        "commit_date": utc(run.about("commit_date", run.date)),
        "dirty": run.about("dirty") == "yes",
        "machine_id": run.machine_id,
        "cores": _whole(run.about("cores", str(run.context.get("num_cpus", "")))),
        "isa": run.about("isa"),
        "compiler": run.about("compiler"),
        "build_type": run.about("build_type"),
        "mode": run.about("mode"),
        "benchmark": result.name,
        "omp_threads": result.omp_threads,
        "clock": result.clock,
        "real_time_s": {"median": result.median, "min": min(result.seconds), "max": max(result.seconds),
                        "n": len(result.seconds)},
        "counters": result.counters,
    }


def _whole(text: str) -> int | None:
    return int(text) if text.isdecimal() else None


def read(path: Path) -> list[Record]:
    """All lines; none when there is no history yet. A broken line is told with its place."""
    if not path.exists():
        return []
    records = []
    for number, line in enumerate(read_text(path).splitlines(), 1):
        if line.strip():
            records.append(_checked(parse_json(line, str(path), number), f"{path}:{number}"))
    return records


def _checked(line: Any, where: str) -> Record:
    if not isinstance(line, dict) or "schema" not in line:
        raise BadInput(f"{where}: no line of a history: it names no schema")
    if line["schema"] != SCHEMA:
        raise BadInput(f"{where}: schema {line['schema']}; this version of Cinch reads schema {SCHEMA}")
    time = line.get("real_time_s")
    if not isinstance(time, dict) or not {"median", "min", "max", "n"} <= time.keys():
        raise BadInput(f"{where}: real_time_s must hold median, min, max and n")
    missing = {"run", "date", "commit", "commit_date", "machine_id", "benchmark"} - line.keys()
    if missing:
        raise BadInput(f"{where}: lacks {', '.join(sorted(missing))}")
    return line


def append(path: Path, run: Run) -> int:
    """Adds a run's results and says how many; none if the history has this run of this machine already."""
    if any(old["run"] == run.id and old["machine_id"] == run.machine_id for old in read(path)):
        return 0
    lines = [json.dumps(record(run, result), allow_nan=False) + "\n"
             for result in run.results.values() if result.seconds]
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as file:
        file.write("".join(lines))  # at once: a signal leaves all of a run or nothing
    return len(lines)


def main() -> int:
    parser = Parser(prog="bench/history.py", description="Adds stored runs to a history.")
    parser.add_argument("history", type=Path, help="file of JSON lines, made when missing")
    parser.add_argument("runs", type=Path, nargs="+", metavar="RUN", help="stored run: Google Benchmark's JSON")
    given = parser.parse_args()
    for run in [read_run(path) for path in given.runs]:
        print(f"{run.path}: {append(given.history, run)} lines added")
    return 0


if __name__ == "__main__":
    run_main(main)
