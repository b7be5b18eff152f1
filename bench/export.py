#!/usr/bin/env python3
"""Writes a stored run in the forms that benchmark dashboards take:

    bench/export.py RUN --out FOLDER

bencher.json                  Bencher Metric Format: `bencher run --adapter json --file bencher.json`
github-action-benchmark.json  `tool: customSmallerIsBetter` of github-action-benchmark
results.csv                   one line for each benchmark, counters as columns

Times of all three go by the clock that results.csv names, the wall's or, as for elements and kernels, the processor's.
"""
from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

from command_line import Parser, run_main
from stored_run import Result, Run, read_run


def bencher(run: Run) -> dict[str, Any]:
    """Bencher Metric Format: time and range as its built-in measure `latency`, in nanoseconds, and all counters."""
    return {result.name: {
        "latency": {"value": 1e9 * result.median, "lower_value": 1e9 * min(result.seconds),
                    "upper_value": 1e9 * max(result.seconds)},
        **{key: {"value": value} for key, value in result.counters.items()},
    } for result in _timed(run)}


def smaller_is_better(run: Run) -> list[dict[str, Any]]:
    """github-action-benchmark keeps no counters: they go into the text that it shows with a point."""
    return [{
        "name": result.name,
        "unit": "ns/iter",
        "value": 1e9 * result.median,
        "range": f"{1e9 * min(result.seconds):.6g} .. {1e9 * max(result.seconds):.6g}",
        "extra": "\n".join([f"repetitions: {len(result.seconds)}",
                            *(f"{key}: {value:.6g}" for key, value in result.counters.items())]),
    } for result in _timed(run)]


def as_csv(run: Run) -> str:
    """One line for each benchmark; a counter that it lacks stays empty."""
    counters = sorted({key for result in _timed(run) for key in result.counters})
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["date", "commit", "machine_id", "isa", "compiler", "mode", "benchmark", "clock", "median_s",
                     "min_s", "max_s", "n", *counters])
    about = [run.date, run.about("commit"), run.machine_id, *(run.about(key) for key in ("isa", "compiler", "mode"))]
    for result in _timed(run):
        writer.writerow([*about, result.name, result.clock, result.median, min(result.seconds), max(result.seconds),
                         len(result.seconds), *(result.counters.get(key, "") for key in counters)])
    return text.getvalue()


def _timed(run: Run) -> list[Result]:
    return [result for result in run.results.values() if result.seconds]


def write_all(run: Run, folder: Path) -> list[Path]:
    """Writes the three files and says where."""
    texts = {
        "bencher.json": json.dumps(bencher(run), indent=2, allow_nan=False) + "\n",
        "github-action-benchmark.json": json.dumps(smaller_is_better(run), indent=2, allow_nan=False) + "\n",
        "results.csv": as_csv(run),
    }
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return [folder / name for name in texts]


def main() -> int:
    parser = Parser(prog="bench/export.py", description="Writes a stored run for benchmark dashboards.")
    parser.add_argument("run", type=Path, metavar="RUN", help="stored run: Google Benchmark's JSON")
    parser.add_argument("--out", type=Path, required=True, metavar="FOLDER", help="where the files go")
    given = parser.parse_args()
    for path in write_all(read_run(given.run), given.out):
        print(f"export: {path}")
    return 0


if __name__ == "__main__":
    run_main(main)
