"""What many captures have in common: medians and ranges of their summaries.  captures.py SUMMARY.json..."""
from __future__ import annotations

import json
import statistics
import sys
from pathlib import Path
from typing import Any

from command_line import run_main
from text import number, table

Summary = dict[str, Any]


def time_of(summary: Summary, kind: str) -> float | None:
    """Time of the first event of a kind, s; None where there is none."""
    return next((event["time"] for event in summary["events"] if event["kind"] == kind), None)


MEASURES = {
    "energy residual, J": lambda s: abs(s["energy"]["residual"]),
    "energy residual, relative": lambda s: s["energy"]["relative_residual"],
    "first touch, s": lambda s: time_of(s, "target_contact"),
    "mouth closed, s": lambda s: time_of(s, "mouth_closed"),
    "run time, s": lambda s: s["wall_seconds"],
}


def rows(summaries: list[Summary]) -> list[list[str]]:
    """Name, median, least, greatest and number of runs for each measure that some run has."""
    found = []
    for name, measure in MEASURES.items():
        values = [value for value in map(measure, summaries) if value is not None]
        if values:
            found.append([name, *(number(of(values)) for of in (statistics.median, min, max)), str(len(values))])
    return found


def main() -> int:
    summaries = [json.loads(Path(name).read_text(encoding="utf-8")) for name in sys.argv[1:]]
    print(table(["", "median", "least", "greatest", "runs"], rows(summaries)))
    return 0


if __name__ == "__main__":
    run_main(main)
