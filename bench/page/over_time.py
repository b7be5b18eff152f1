"""The history in the page: for each place and benchmark one point a commit. A place is a machine with an instruction
set, a compiler and a mode of bench/run: times of different places are never joined."""
from __future__ import annotations

import statistics
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from comparison import TOLERANCE, Spread, judge
from history import Record
from names import parse
from page.figure import Badge, Cell, Row, label
from stored_run import MADE_WITH, PROCESSOR
from text import duration


@dataclass(frozen=True)
class Point:
    """All runs of one benchmark at one commit in one place."""

    when: float  # ms since 1970, as JavaScript counts
    commit: str
    spread: Spread
    repetitions: int



def points(records: list[Record]) -> dict[str, dict[str, list[Point]]]:
    """Points by place, those of a machine in a row, then by benchmark, in the order of time."""
    machines = list(dict.fromkeys(record["machine_id"] for record in records))
    records = sorted(records, key=lambda record: machines.index(record["machine_id"]))
    groups: dict[tuple[str, str], dict[tuple[str, str], list[Record]]] = {}
    by_processor = {record["benchmark"] for record in records if record.get("clock") == PROCESSOR}
    for record in records:
        commits = groups.setdefault((_place(record), _benchmark(record, by_processor)), {})
        # changes that are no commit yet are a point of their own for each run, at the time of the run
        own = record["run"] if record.get("dirty") else ""
        commits.setdefault((record["commit"], own), []).append(record)
    found: dict[str, dict[str, list[Point]]] = {}
    for (place, benchmark), commits in groups.items():
        row = sorted((_point(same) for same in commits.values()), key=lambda point: point.when)
        found.setdefault(place, {})[benchmark] = row
    return found


def _place(record: Record) -> str:
    return f'{record["machine_id"]}; ' + ", ".join(str(record.get(key) or "unknown") for key in MADE_WITH)


def _benchmark(record: Record, by_processor: set[str]) -> str:
    """Times on the wall, as lines without a clock hold, are a curve of their own beside those of the processor."""
    name = str(record["benchmark"])
    return f"{name} (on the wall)" if name in by_processor and record.get("clock") != PROCESSOR else name


def _point(records: list[Record]) -> Point:
    times = [record["real_time_s"] for record in records]
    last = records[-1]
    dirty = last.get("dirty")
    commit = last["commit"] + (" with changes" if dirty else "")
    spread = Spread(statistics.median(time["median"] for time in times), min(time["min"] for time in times),
                    max(time["max"] for time in times), any(time["n"] > 1 for time in times))
    when = _milliseconds(last["date"] if dirty else last["commit_date"])
    return Point(when, commit, spread, sum(time["n"] for time in times))


def _milliseconds(date: str) -> float:
    try:
        return 1000 * datetime.fromisoformat(date.replace("Z", "+00:00")).timestamp()
    except ValueError:
        return 0.0


def chart_data(place: dict[str, list[Point]]) -> dict[str, Any]:
    """What dashboard.js draws for one place: when, median, least, greatest in seconds, n, commit. Without a range least
    and greatest are null."""
    def seconds(point: Point) -> list[float | None]:
        ends = (point.spread.least, point.spread.greatest)
        return [_short(point.spread.median), *(_short(end) if point.spread.repeated else None for end in ends)]
    return {benchmark: [[point.when, *seconds(point), point.repetitions, point.commit] for point in row]
            for benchmark, row in place.items()}


def _short(seconds: float) -> float:
    return float(f"{seconds:.6g}")


@dataclass(frozen=True)
class Change:
    """The latest point of a benchmark against the one before."""

    benchmark: str
    before: Point
    after: Point
    verdict: str


def latest_changes(place: dict[str, list[Point]]) -> list[Change]:
    """What the latest commit of a place changed, largest change first; benchmarks it did not run are left out."""
    latest = max((row[-1].when for row in place.values()), default=0.0)
    changes = [Change(benchmark, row[-2], row[-1], judge(row[-2].spread, row[-1].spread, TOLERANCE))
               for benchmark, row in place.items()
               if len(row) > 1 and row[-1].when == latest]
    return sorted(changes, key=lambda change: -abs(change.after.spread.median / change.before.spread.median - 1))


def change_rows(changes: list[Change]) -> list[Row]:
    """Rows of the table of changes; what stayed the same is left out."""
    return [change_row(change) for change in changes if change.verdict != "same"]


def change_row(change: Change) -> list[Cell]:
    before, after = change.before.spread.median, change.after.spread.median
    return [change.benchmark, change.before.commit, duration(before), change.after.commit, duration(after),
            f"{100 * (after / before - 1):+.1f} %", change.verdict]


def headlines(points_of: dict[str, dict[str, list[Point]]]) -> list[Row]:
    """Rows of a table: whole cases and closing phases with one thread at each place's latest commit against the one
    before, what stayed the same, too."""
    rows: list[Row] = []
    for place, benchmarks in points_of.items():
        for change in sorted(latest_changes(benchmarks), key=lambda change: change.benchmark):
            name = parse(change.benchmark)
            if name.suite == "case" and name.parts[-1:] in (("whole",), ("closing",)) and name.threads == 1:
                look = {"slower": "poor", "faster": "good", "same": "none"}[change.verdict]
                rows.append([label(name.scene), *change_row(change)[1:-1], Badge(change.verdict, look), place])
    return rows


def first_choice(benchmarks: list[str]) -> str:
    """The benchmark shown at first: the paper's capture, if it is there."""
    wanted = ["case/capture/whole/threads:1", "case/capture/closing/threads:1"]
    cases = [name for name in benchmarks if name.startswith("case/")]
    return next((name for name in [*wanted, *cases, *benchmarks] if name in benchmarks), "")
