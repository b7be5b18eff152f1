"""Figures of error against run time, from what bench/study has found."""
from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from command_line import BadInput
from page.figure import GREY, Figure, Row, Series, Table, lines, origin, rounded
from stored_run import parse_json, read_text
from text import number

Study = dict[str, Any]
Problem = dict[str, Any]

COMMAND = "bench/study"
SMALL_RESIDUAL = 1e-4  # of the energy, relative
COLOURS = [0, 1, 2, 3, 5, 6, 7]  # grey is the paper's


def read_study(path: Path | None) -> Study | None:
    """A study's problems, and by what and where it was made; none when there is no such file."""
    if path is None or not path.exists():
        return None
    data = parse_json(read_text(path), str(path))
    problems = data.get("problems") if isinstance(data, dict) else None
    known = isinstance(problems, list) and all(
        isinstance(problem, dict) and {"name", "title", "measure", "reference_error", "runs", "best", "orders"}
        <= problem.keys() for problem in problems)
    if not known:
        raise BadInput(f'{path}: must hold "problems" as bench/study writes them')
    return data


def figures(study: Study | None) -> list[Figure]:
    """One figure for each problem; without a study one that says how to have it."""
    if not study or not study["problems"]:
        return [Figure("Error against run time", "", COMMAND, [], [], {"series": []})]
    return [precision(problem, origin(study)) for problem in study["problems"]]


def precision(problem: Problem, made: str) -> Figure:
    """Each run as a point: run time across, error upwards; one curve for each method and choice of step."""
    runs = [run for run in problem["runs"] if "failure" not in run]
    curves: dict[str, list[Any]] = {run["series"]: [] for run in runs}
    for run in sorted(runs, key=lambda run: run["elements"]):
        curves[run["series"]].append(_point(run))
    series = [Series(name, COLOURS[i % len(COLOURS)], points) for i, (name, points) in enumerate(curves.items())]
    papers = [_point(run) for run in runs if run["papers_choice"]]
    others = _other_measures(problem)
    return Figure(
        f"Error against run time: {problem['title']}", f"{_caption(problem)} {made}", COMMAND,
        ["method and step", "elements", "step, s", "runs", "error, %", "a run from the mean, %", "run time, s/s",
         "energy residual", "order as far as errors fall", "order in the step",
         *(f"{_words(problem, name)}, %" for name in others), "remark"],
        [*(_row(problem, run, others) for run in problem["runs"]), _of_reference(problem, others)],
        lines([Series("the paper's own choices", GREY, papers), *series],  # the first is drawn on top
              {"title": "run time per simulated second, s", "log": True}, {"title": "error, %", "log": True}),
        _findings(problem))


def _point(run: dict[str, Any]) -> tuple[float | None, float | None]:
    return rounded(run["seconds_per_simulated_second"]), rounded(100 * run["errors"]["error"])


def _other_measures(problem: Problem) -> list[str]:
    """All but the first; older files have none."""
    return [name for name in problem.get("measures", {}) if name != "error"]


def _words(problem: Problem, measure: str) -> str:
    chance = " (by chance)" if problem["measures"][measure]["chaotic"] else ""
    return measure.replace("_", " ") + chance


def _row(problem: Problem, run: dict[str, Any], others: list[str]) -> Row:
    if "failure" in run:
        return [run["series"], run["elements"], *[None] * (8 + len(others)), run["failure"]]
    apart = run["errors"].get("one_run_from_the_mean")  # where a problem is chaotic
    return [run["series"], run["elements"], run["step_s"], run["runs"], 100 * run["errors"]["error"], _percent(apart),
            run["seconds_per_simulated_second"], run["energy_residual"], problem["orders"].get(run["series"]),
            problem.get("step_orders", {}).get(run.get("but_for_the_step")),
            *(_percent(run["errors"].get(name)) for name in others),
            "the paper's choice" if run["papers_choice"] else ""]


def _percent(share: float | None) -> float | None:
    return None if share is None else 100 * share


def _caption(problem: Problem) -> str:
    """What the error is."""
    runs = max(run["runs"] for run in problem["runs"])  # more than one where a problem is chaotic
    means = f", of means over up to {runs} runs that begin a little apart" if runs > 1 else ""
    return (f"Lower left is better. Error: {problem['measure']}{means}. The fastest are within an error with what chance "
            f"may add and what the reference may be off by, {number(100 * problem['reference_error'])} %.")


def best_within(problem: Problem, error: float, residual: float = math.inf) -> dict[str, Any] | None:
    """The fastest run that is within `error` for certain: chance and the reference may be off the other way; and whose
    energy residual is no more than `residual`. Found from the runs, as what an older file names best may leave the
    reference out."""
    runs = [run for run in problem["runs"] if "failure" not in run and run["energy_residual"] <= residual and
            run["errors"]["error"] + run["errors"].get("uncertainty", 0) + problem["reference_error"] <= error]
    return min(runs, key=lambda run: run["seconds_per_simulated_second"], default=None)


def _findings(problem: Problem) -> Table:
    """The fastest setting for each wanted error, of all and of those that account for the energy."""
    rows: list[Row] = []
    for wanted in problem["best"]:
        error = wanted["error"]
        any_run, sound = best_within(problem, error), best_within(problem, error, SMALL_RESIDUAL)
        why = f"none ({wanted['why']})" if "why" in wanted else "none"  # older files do not say
        rows.append([f"{100 * error:g} %", *_best(any_run, why), *_best(sound, "none")])
    return ["within", "fastest", "s/s", f"with an energy residual of {SMALL_RESIDUAL:g} at most", "s/s"], rows


def _best(run: dict[str, Any] | None, none: str) -> tuple[str, float | None]:
    if run is None:
        return none, None
    return f"{run['series']}, {run['elements']} elements", run["seconds_per_simulated_second"]


def _of_reference(problem: Problem, others: list[str]) -> Row:
    """What the reference itself may be off by."""
    errors = [problem["measures"][name]["reference_error"] for name in others]
    return ["the reference itself", None, None, None, 100 * problem["reference_error"], *[None] * 5,
            *(_percent(error) for error in errors), ""]
