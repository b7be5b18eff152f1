"""The figure of other programs: their run times beside those that this run has measured of the same scenes."""
from __future__ import annotations

from other_programs import MACHINE, SCENES, Scene, minutes_of_step
from page.figure import GREY, Figure, Series, bars, by_scene, column, first_cells, measure, per_update_ns
from stored_run import Run
from text import number

PATTERN = "^(element|growth/(99856|1000000))/"


def figure(run: Run) -> Figure:
    """Minutes per simulated second of each program and scene beside Cinch's; scenes that Cinch lacks are named."""
    rows: list[tuple[str, float, float, float]] = []
    lacking = []
    for scene in SCENES:
        own = cinch_minutes(run, scene)
        if own is None:
            lacking.append(scene.words)
        else:
            rows += [(f"{scene.words}: {program}", theirs, own, theirs / own)
                     for program, theirs in scene.minutes.items()]
    series = [Series("the other program", GREY, column(rows, 1)), Series("Cinch, in this run", 0, column(rows, 2))]
    return Figure(
        "Other programs at steps of 1e-6 s", _caption(rows, lacking), measure(PATTERN),
        ["scene and program", "the other, min/s", "Cinch, min/s", "times faster"], rows,
        bars(first_cells(rows), series, "run time per simulated second, minutes", log=True))


def cinch_minutes(run: Run, scene: Scene) -> float | None:
    """Minutes per simulated second at the others' step, from the time of one element and step."""
    result = by_scene(run.parsed()).get(scene.benchmark, {}).get(scene.threads)
    each = per_update_ns(result) if result else None
    elements = result.counters.get("elements", scene.elements) if result else None
    return minutes_of_step(1e-6 * each * elements) if each and elements else None


def _caption(rows: list[tuple[str, float, float, float]], lacking: list[str]) -> str:
    words = (f"Shorter is better, on a logarithmic scale. {_range(rows)}The others were measured once, on {MACHINE} "
             "with AVX-512, outside this suite (bench/README.md): ratios hold where this run's machine is such a one. All "
             "scenes stay taut, and Cinch keeps its energy ledger.")
    return words + (f" Not measured in this run: {'; '.join(lacking)}. To measure them: {measure(PATTERN)}"
                    if lacking else "")


def _range(rows: list[tuple[str, float, float, float]]) -> str:
    """The least and the greatest lead."""
    if not rows:
        return ""
    least, most = (choose(rows, key=lambda row: row[3]) for choose in (min, max))
    return f"Cinch is {number(least[3])} ({least[0]}) to {number(most[3])} ({most[0]}) times as fast. "
