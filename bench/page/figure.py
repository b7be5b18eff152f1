"""What a figure of the dashboard is made of, and the two kinds of charts that dashboard.js draws."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Iterable, Sequence, Union

import names
from stored_run import Result, Run



@dataclass(frozen=True)
class Badge:
    """A word that tells good from bad by its colour."""

    words: str
    look: str  # good, fair, poor or none, as the page's style names them


Cell = Union[str, float, Badge, None]  # None: not measured
Row = Sequence[Cell]
Chart = dict[str, Any]
Table = tuple[list[str], Sequence[Row]]  # headers, rows


@dataclass
class Figure:
    """A chart, how to read it and its numbers. Without rows the run has not measured it; without a chart the table is
    all there is."""

    title: str
    caption: str  # one sentence: how to read it, what is good
    command: str  # what measures it
    headers: list[str]
    rows: Sequence[Row]
    chart: Chart = field(default_factory=dict)
    findings: Table | None = None  # what to read off the chart, shown below its caption


@dataclass(frozen=True)
class Series:
    """One colour of a chart: values by category for bars, points (x, y) for lines."""

    label: str
    colour: int  # --s0 to --s7 of the page's style
    values: list[Any]
    dashed: bool = False


GREY = 4  # colour of what is not Cinch's own: the paper, ideals, remainders


def bars(categories: list[str], series: Iterable[Series], title: str, *, log: bool = False, stacked: bool = False,
         most: float | None = None) -> Chart:
    """Horizontal bars, so that long names stay readable. `title` names what the bars' length stands for."""
    return {"type": "bar", "categories": categories, "value": {"title": title, "log": log, "max": most},
            "stacked": stacked, "series": _drawn(series)}


def lines(series: Iterable[Series], x: dict[str, Any], y: dict[str, Any]) -> Chart:
    """Curves over numbers. Axes: title, log (false), ticks (where to put them; chosen when left out), max."""
    return {"type": "line", "x": x, "y": y, "series": _drawn(series)}


def _drawn(series: Iterable[Series]) -> list[dict[str, Any]]:
    """Series without a single value would only fill the legend."""
    return [{"label": one.label, "colour": one.colour % 8, "dashed": one.dashed, "values": one.values}
            for one in series if any(value is not None for value in one.values)]


def measure(pattern: str) -> str:
    """The command that measures the benchmarks whose names match."""
    return f"bench/run --benchmark_filter='{pattern}'"


def of_suite(run: Run, suite: str) -> list[tuple[names.Name, Result]]:
    """All results of one suite that have times, with their names in parts."""
    return [(name, result) for name, result in run.parsed() if name.suite == suite]


def by_scene(pairs: Iterable[tuple[names.Name, Result]]) -> dict[str, dict[int, Result]]:
    """Results by scene, then by number of threads in rising order."""
    scenes: dict[str, dict[int, Result]] = {}
    for name, result in pairs:
        scenes.setdefault(name.scene, {})[result.omp_threads or 1] = result
    return {scene: dict(sorted(results.items())) for scene, results in scenes.items()}


def label(scene: str) -> str:
    """`case/capture/closing` in words: "capture, closing"."""
    return ", ".join(part.replace("_", " ") if i else part for i, part in enumerate(scene.split("/")[1:]))


def per_update_ns(result: Result) -> float | None:
    """Nanoseconds for one element and step."""
    updates = result.counters.get("element_updates_per_second")
    return 1e9 / updates if updates else None


def counter(result: Result, key: str, factor: float = 1.0) -> float | None:
    """A counter in another unit, or None."""
    value = result.counters.get(key)
    return None if value is None else value * factor


def whole(value: float | None) -> int | None:
    """A counter that counts things: tables show all its digits."""
    return None if value is None else round(value)


def origin(data: Chart, how: str = "measured") -> str:
    """By what and where a figure was measured that is not of the page's own run."""
    machine = ", ".join(str(data[key]) for key in ("machine", "cpu") if data.get(key))
    return (f"Not of this page's run: {how} at commit {data.get('commit') or 'unknown'} on "
            f"{machine or 'an unknown machine'}, instruction set {data.get('isa') or 'unknown'}.")


def first_cells(rows: Sequence[Row]) -> list[str]:
    """The first column, as the names of bars."""
    return [str(row[0]) for row in rows]


def column(rows: Sequence[Row], index: int) -> list[float | None]:
    """A column of numbers, as the lengths of bars."""
    cells = [row[index] for row in rows]
    return [None if isinstance(cell, (str, Badge)) else rounded(cell) for cell in cells]


def rounded(value: float | None) -> float | None:
    """Seven digits are more than any clock gives, and keep the page small."""
    return None if value is None else float(f"{value:.7g}")
