"""Figures of the stability matrix, from what bench/stability has found."""
from __future__ import annotations

from pathlib import Path
from typing import Any, Callable

from command_line import BadInput
from page.figure import Figure, Row, Series, bars, lines, origin, rounded
from stored_run import parse_json, read_text

Matrix = dict[str, Any]
CellOf = dict[str, Any]

COMMAND = "bench/stability"
VERDICTS = [("held", 2), ("stopped", 0), ("FAILED", 1)]  # with colours
COLOURS = [0, 1, 2, 3, 5, 6, 7]  # without grey
WHAT = {"held", "stopped", "failed", "name"}
CELL = {"group", "parameter", "value", "must", "verdict", "residual", "steps", "message", "place"}


def read_stability(path: Path | None) -> Matrix | None:
    """The matrix; none when there is no such file."""
    if path is None or not path.exists():
        return None
    data = parse_json(read_text(path), str(path))
    lists = (data.get("groups"), data.get("cells")) if isinstance(data, dict) else (None, None)
    known = all(isinstance(items, list) and all(isinstance(item, dict) and keys <= item.keys() for item in items)
                for items, keys in zip(lists, (WHAT, CELL)))
    if not known:
        raise BadInput(f'{path}: must hold "groups" and "cells" as bench/stability writes them')
    return data


def figures(matrix: Matrix | None) -> list[Figure]:
    """Verdicts of all cells and where residuals grow; without a matrix one figure that says how to have it."""
    if matrix is None:
        return [Figure("Stability matrix", "", COMMAND, [], [], {"series": []})]
    return [verdicts(matrix), stiffness(matrix), slack(matrix), impacts(matrix)]


def verdicts(matrix: Matrix) -> Figure:
    """How many cells of each group held, were stopped or failed; all cells in the table."""
    groups = matrix["groups"]
    series = [Series(words, colour, [group[words.lower()] for group in groups]) for words, colour in VERDICTS]
    return Figure(
        "Stability matrix: verdicts",
        "Held: bounded, its energy accounted for. Stopped: by a message that names item, time and cause. FAILED: "
        f"neither; there must be none. Mode: {matrix.get('mode', 'quick')}. {origin(matrix)}",
        COMMAND, ["group", "parameter", "value", "must", "verdict", "energy residual", "steps", "message"],
        [_row(cell) for cell in matrix["cells"]],
        bars([group["name"] for group in groups], [one for one in series if any(one.values)], "cells", stacked=True))


def stiffness(matrix: Matrix) -> Figure:
    """Residual over the modulus, a curve for each element length."""
    cells = _cells(matrix, "stiffness", "modulus, element length")
    return _figure(
        matrix, "Energy residual with the automatic step, over modulus and element length",
        "Low is good, level as well: the automatic step then suits them all.", cells,
        lambda cell: f"{cell['place']['element_m']:g} m", "modulus_Pa", "Young's modulus, Pa", log=True)


def slack(matrix: Matrix) -> Figure:
    """Residual over the step, a curve for each damping and way to begin."""
    return _figure(
        matrix, "Energy residual of a thread that turns slack and taut",
        "Low is good; runs above 0.05 were stopped. Undamped threads need steps far below the stable one.",
        [cell for cell in matrix["cells"] if cell["group"] == "slack and taut"],
        lambda cell: f"{cell['parameter'].split(',')[0]}, damping ratio {cell['place']['damping']:g}",
        "step_fraction", "step over the stable step", log=False)


def impacts(matrix: Matrix) -> Figure:
    """Residual over the speed, a curve for what hits what."""
    return _figure(
        matrix, "Energy residual of impacts with the automatic step",
        "Low is good; what is too hard for the step was stopped and told with a step that would carry it.",
        [cell for cell in matrix["cells"] if "speed_m_s" in cell["place"]],
        lambda cell: cell["parameter"].removesuffix(", speed"), "speed_m_s", "speed, m/s", log=True)


def _cells(matrix: Matrix, group: str, parameter: str) -> list[CellOf]:
    return [cell for cell in matrix["cells"] if (cell["group"], cell["parameter"]) == (group, parameter)]


def _figure(matrix: Matrix, title: str, caption: str, cells: list[CellOf], label: Callable[[CellOf], str], across: str,
            words: str, *, log: bool) -> Figure:
    curves: dict[str, list[tuple[float, float | None]]] = {}
    for cell in cells:
        curves.setdefault(label(cell), []).append((cell["place"][across], _drawable(cell["residual"])))
    series = [Series(name, COLOURS[i % len(COLOURS)], sorted(points, key=lambda point: point[0]))
              for i, (name, points) in enumerate(curves.items()) if any(y is not None for _, y in points)]
    rows: list[Row] = [[label(cell), cell["place"][across], cell["residual"], cell["verdict"]] for cell in cells]
    return Figure(title, f"{caption} {origin(matrix)}", COMMAND, ["curve", words, "energy residual", "verdict"], rows,
                  lines(series, {"title": words, "log": log}, {"title": "energy residual", "log": True}))


def _drawable(residual: float | None) -> float | None:
    """A logarithmic axis has no place for zero."""
    return rounded(residual) if residual else None


def _row(cell: CellOf) -> Row:
    return [cell[key] for key in ("group", "parameter", "value", "must", "verdict", "residual", "steps", "message")]
