"""Figures of whole cases: run time beside the paper's, and which stage of the steps takes it."""
from __future__ import annotations

import paper_times
from page.figure import (GREY, Chart, Figure, Row, Series, bars, by_scene, column, counter, first_cells, label,
                         measure, of_suite, per_update_ns, rounded)
from stored_run import Result, Run


TAUT_NET = "case/large_capture/taut_net"


def minutes(result: Result) -> float | None:
    return counter(result, "minutes_per_simulated_second")


def paper_minutes(scene: str, result: Result) -> float | None:
    """The paper's figure for a whole case, and the same number of elements where it gives several; it has none for
    phases, which take more or less of the run than of the time simulated."""
    if not scene.endswith("/whole"):
        return None
    return paper_times.minutes_per_simulated_second(scene.split("/")[1], result.counters.get("elements"))


def scenes(run: Run) -> dict[str, dict[int, Result]]:
    """Cases with a run time, by scene and threads; whole runs of a case before its phases."""
    found = by_scene(pair for pair in of_suite(run, "case") if minutes(pair[1]))
    return dict(sorted(found.items(), key=lambda item: (item[0].split("/")[1], not item[0].endswith("/whole"))))


def scene_label(scene: str, result: Result) -> str:
    """Cases that come with several numbers of elements are told apart by them."""
    elements = result.counters.get("elements")
    size = f", {elements:.0f} elements" if elements and scene.split("/")[1] == "ring_pull" else ""
    return label(scene) + size


def run_time(run: Run) -> Figure:
    """Minutes a simulated second: with one thread, the best with more where some were tried, and the paper's."""
    rows: list[Row] = []
    for scene, results in scenes(run).items():
        times = {threads: minutes(result) or 0 for threads, result in results.items()}
        more = min((threads for threads in times if threads > 1), key=times.__getitem__, default=None)
        first = next(iter(results.values()))
        theirs = paper_minutes(scene, first)
        rows.append((scene_label(scene, first), times.get(1), times[more] if more else None, more, theirs,
                     theirs / min(times.values()) if theirs else None,
                     per_update_ns(results[1]) if 1 in results else None))
    series = [Series("Cinch, 1 thread", 0, column(rows, 1)),
              Series("Cinch, more threads, the best", 2, column(rows, 2)),
              Series(f"paper, {paper_times.MACHINE}", GREY, column(rows, 4))]
    taut = any(scene == TAUT_NET for scene in scenes(run))
    return Figure(
        "Run time of each case",
        "Shorter is better, on a logarithmic scale; the paper gives one figure for the whole of a case and none for "
        "its phases. More threads: the fastest number of those tried, none where only one was."
        + (" large_capture, taut net is that case's net made soft and taut by 0.1 %, before its threads close." * taut),
        measure("^case/"),
        ["case", "1 thread, min/s", "more threads, min/s", "how many", "paper, min/s", "times faster than the paper",
         "1 thread, ns per element and step"],
        rows, bars(first_cells(rows), series, "run time per simulated second, minutes", log=True))


def times_faster(run: Run) -> list[tuple[str, float]]:
    """How many times faster than the paper each whole case is."""
    found: list[tuple[str, float]] = []
    for scene, results in scenes(run).items():
        fastest = min(minutes(result) or 0 for result in results.values())
        first = next(iter(results.values()))
        theirs = paper_minutes(scene, first)
        if theirs:
            found.append((scene_label(scene, first), theirs / fastest))
    return found


STAGES = ["contacts", "axial_forces", "gather_and_move", "threads_meeting", "broadphase", "observe"]


def stages(run: Run) -> Figure:
    """Shares of the time with one thread and with most threads: the meeting of threads shows only there."""
    found = [(scene, threads, results[threads]) for scene, results in by_scene(of_suite(run, "case")).items()
             for threads in sorted({min(results), max(results)})
             if any(key.startswith("share_") for key in results[threads].counters)]
    stage_names = _stage_names([result for _, _, result in found])
    categories = [f"{label(scene)}, {threads} thread{'s' * (threads > 1)}" for scene, threads, _ in found]
    shares = {stage: [rounded(counter(result, f"share_{stage}", 100)) for _, _, result in found]
              for stage in stage_names}
    shares["rest"] = [max(0.0, round(100 - sum(share or 0 for share in step), 3)) for step in zip(*shares.values())]
    rows = [[category, *(shares[stage][i] for stage in shares)] for i, category in enumerate(categories)]
    return Figure(
        "Where the time goes",
        "Each bar is the time of all steps of a phase, or that of a whole run, with its output and, in the rest, its "
        "start-up; long stages are worth working on, and few percent for threads meeting is good. Shares are those of "
        "the first thread. With AVX-512 chains are moved in the pass that computes their forces: axial forces hold that "
        "move, too.",
        measure("^case/"),
        ["case", *(f"{stage.replace('_', ' ')}, %" for stage in shares)], rows, _stacked(categories, shares))


def _stage_names(results: list[Result]) -> list[str]:
    """The known stages in the order of a step, then any others the benchmarks may name."""
    found = {key.removeprefix("share_") for result in results for key in result.counters if key.startswith("share_")}
    return [stage for stage in STAGES if stage in found] + sorted(found - set(STAGES))


def _stacked(categories: list[str], shares: dict[str, list[float | None]]) -> Chart:
    palette = [colour for colour in range(8) if colour != GREY]
    series = [Series(stage.replace("_", " "), GREY if stage == "rest" else palette[i % len(palette)], values)
              for i, (stage, values) in enumerate(shares.items()) if any(value for value in values)]
    return bars(categories, series, "share of the time, %", stacked=True, most=100)
