"""The figure of absent features: instructions from bench/count, time from the run."""
from __future__ import annotations

from pathlib import Path
from typing import Any

from command_line import BadInput
from page.figure import Figure, Row, Series, bars, column, first_cells, measure, of_suite, origin
from stored_run import Result, Run, parse_json, read_text

Instructions = dict[str, Any]  # "features", and where and when they were counted
COMMAND = "bench/count"


def read_instructions(path: Path | None) -> Instructions | None:
    """Instruction counts of absent features; none when there is no such file. Older files hold the features alone."""
    if path is None or not path.exists():
        return None
    data = parse_json(read_text(path), str(path))
    if not isinstance(data, dict):
        raise BadInput(f"{path}: must hold an object of features")
    counted = data if "features" in data else {"features": data}
    if not isinstance(counted["features"], dict):
        raise BadInput(f'{path}: "features" must hold an object')
    for feature, counts in counted["features"].items():
        known = isinstance(counts, dict) and all(isinstance(counts.get(key), (int, float))
                                                 for key in ("counted", "stripped"))
        if not known:
            raise BadInput(f'{path}: "{feature}" must hold the numbers "counted" and "stripped"')
    return counted


def worst(instructions: Instructions | None) -> float | None:
    """The most that an absent feature adds to a step's instructions, in per cent."""
    extra = [_extra_work(counts) for counts in _features(instructions).values()]
    return max((one for one in extra if one is not None), default=None)


def figure(run: Run, instructions: Instructions | None) -> Figure:
    """What a feature costs a scene that does not use it. Instructions come first: times of single runs are noise."""
    sides: dict[str, dict[str, Result]] = {}
    for name, result in of_suite(run, "absent"):
        if len(name.parts) == 2 and result.counters.get("element_updates_per_second"):
            sides.setdefault(name.parts[0], {})[name.parts[1]] = result
    counts = _features(instructions)
    costs = [(feature.replace("_", " "), _extra_work(counts.get(feature, {})), _extra_time(sides.get(feature, {})))
             for feature in dict.fromkeys([*counts, *sides])]
    rows: list[Row] = [row for row in costs if row[1] is not None or row[2] is not None]
    repeated = all(len(result.seconds) > 1 for both in sides.values() for result in both.values())
    drawn = [row for row in rows if repeated or row[1] is not None]
    series = [Series("instructions", 1, column(drawn, 1)), Series("time", 0, column(drawn, 2) if repeated else [])]
    chart = bars(first_cells(drawn), series, "extra cost of a step, %")
    return Figure("What absent features cost", _caption(instructions, repeated), measure("^absent/"),
                  ["feature", "extra instructions, %", "extra time, %"], rows, chart if chart["series"] else {})


def _caption(instructions: Instructions | None, repeated: bool) -> str:
    words = ("Extra instructions and time of the solver's step in a scene that lacks the feature, against a program "
             "stripped of it by hand; 0 % is good. Times of single runs are noise of some ten per cent")
    words += ". " if repeated else " and stand in the table alone: bench/run --full repeats them. "
    if instructions is None:
        return words + f"Instructions have not been counted: {COMMAND} does it, in a minute."
    date = f", on {instructions['date']}" if instructions.get("date") else ""
    made = origin(instructions, "counted")
    return words + f"Instructions: {made[0].lower()}{made[1:-1]}{date}."


def _features(instructions: Instructions | None) -> dict[str, dict[str, float]]:
    return instructions["features"] if instructions else {}


def _extra_time(sides: dict[str, Result]) -> float | None:
    if not {"with", "without"} <= sides.keys():
        return None
    speeds = {side: result.counters["element_updates_per_second"] for side, result in sides.items()}
    return 100 * (speeds["without"] / speeds["with"] - 1)


def _extra_work(counts: dict[str, float]) -> float | None:
    if not counts.get("stripped") or "counted" not in counts:
        return None
    return 100 * (counts["counted"] / counts["stripped"] - 1)
