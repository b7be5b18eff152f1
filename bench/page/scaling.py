"""Figures of size and threads: growth, memory, speed-up, and how long a step is beside a hand-over."""
from __future__ import annotations

from typing import Callable

from page.figure import (GREY, Figure, Row, Series, bars, by_scene, column, counter, first_cells, label, lines,
                         measure, of_suite, per_update_ns, rounded, whole)
from stored_run import Result, Run

MOST_CURVES = 7  # the colours but grey
LEAST_NODES = 99_000  # of nets whose memory is told: that of smaller ones drowns in what a process takes anyway
MOST_FLOWN = 0.01  # share of the steps beyond which their mean length says nothing of a single step


def nodes(scene: str, result: Result) -> int | None:
    """Size of a growing net; its name gives it where the counter is missing."""
    named = scene.split("/")[1]
    return whole(result.counters.get("nodes", float(named) if named.isdecimal() else None))


def _over_nodes(run: Run, value: Callable[[Result], float | None]) -> list[Series]:
    """One curve over the nodes for each number of threads."""
    curves: dict[int, list[tuple[int, float]]] = {}
    for scene, results in by_scene(of_suite(run, "growth")).items():
        for threads, result in results.items():
            x, y = nodes(scene, result), value(result)
            if x and y is not None:
                curves.setdefault(threads, []).append((x, float(f"{y:.7g}")))
    return [Series(f"{threads} thread{'s' * (threads > 1)}", _curve_colour(i), sorted(curves[threads]))
            for i, threads in enumerate(sorted(curves))]


def _curve_colour(i: int) -> int:
    """Grey is kept for ideals."""
    return [0, 1, 2, 3, 5, 6, 7][i % MOST_CURVES]


def growth(run: Run) -> Figure:
    """Time of one element and step against the size of a flying net."""
    rows: list[Row] = []
    for scene, results in by_scene(of_suite(run, "growth")).items():
        for threads, result in results.items():
            rows.append([nodes(scene, result), whole(result.counters.get("elements")), threads, per_update_ns(result),
                         counter(result, "bytes_per_second", 1e-9), counter(result, "fraction_of_triad", 100)])
    return Figure(
        "Time of one element and step against the size of the net",
        "Level curves are good; a rise marks a cache that the net has outgrown, and more threads should lie lower.",
        measure("^growth/"),
        ["nodes", "elements", "threads", "ns per element and step", "GB/s of single steps", "share of triad, %"],
        rows, lines(_over_nodes(run, per_update_ns), {"title": "nodes", "log": True},
                    {"title": "time per element and step, ns"}))


def triad_share(run: Run) -> Figure:
    """Traffic of steps that each go through memory, as a share of what the machine can move at best."""
    def share(result: Result) -> float | None:
        return counter(result, "fraction_of_triad", 100)
    rows: list[Row] = [(series.label, *point) for series in _over_nodes(run, share) for point in series.values]
    return Figure(
        "Traffic that single steps cannot avoid, as a share of the triad",
        "High is good: 96 bytes a node for each step, against the triad's 24 bytes an item. It is no measured traffic "
        "and may lie above 100 %: small nets live in caches, and above 8,000 nodes up to four steps share one sweep "
        "through memory.",
        measure("^(growth|machine)/"), ["threads", "nodes", "share of triad, %"], rows,
        lines(_over_nodes(run, share), {"title": "nodes", "log": True}, {"title": "share of triad, %"}))


def triad(run: Run) -> Figure:
    """What the machine's memory gives: a[i] = b[i] + s c[i] on arrays larger than its caches."""
    results = by_scene(of_suite(run, "machine")).get("machine/triad", {})
    rows: list[Row] = [(f"{threads} thread{'s' * (threads > 1)}", counter(result, "bytes_per_second", 1e-9))
                       for threads, result in results.items() if "bytes_per_second" in result.counters]
    return Figure(
        "Memory bandwidth of the machine: triad",
        "Longer is better: 24 bytes an item, read and written; threads beyond the number where the bars stop growing "
        "speed up no net that goes through memory in each step.",
        measure("^machine/"), ["threads", "GB/s"], rows,
        bars(first_cells(rows), [Series("triad", 6, column(rows, 1))], "bandwidth, GB/s"))


def memory(run: Run) -> Figure:
    """Bytes of memory for each node and element of large nets."""
    def size(result: Result) -> float | None:
        return counter(result, "bytes_per_item") if result.counters.get("nodes", 0) >= LEAST_NODES else None
    rows: list[Row] = [(series.label, *point) for series in _over_nodes(run, size) for point in series.values]
    return Figure(
        "Memory of each node and element",
        "Low and level is good: what rises with the size of the net would limit it. Nets below 10^5 nodes are left "
        "out: what a process holds resident says little of so small ones.",
        measure("^growth/"), ["threads", "nodes", "bytes per node and element"], rows,
        lines(_over_nodes(run, size), {"title": "nodes", "log": True}, {"title": "memory per node and element, bytes"}))


def speed(result: Result) -> float:
    """Work a second: steps or element updates where counted, else iterations. Free flight counts steps alone."""
    counters = result.counters
    return counters.get("steps_per_second") or counters.get("element_updates_per_second") or 1 / result.median


def _threaded(run: Run) -> dict[str, dict[int, Result]]:
    """Scenes measured with one thread and with more: whole cases first, then nets from the largest down."""
    cases, nets = by_scene(of_suite(run, "case")), by_scene(of_suite(run, "growth"))
    by_size = sorted(nets, key=lambda scene: -(nodes(scene, next(iter(nets[scene].values()))) or 0))
    whole_first = sorted(cases, key=lambda scene: not scene.endswith("/whole"))
    both = {scene: (cases | nets)[scene] for scene in [*whole_first, *by_size]}
    return {scene: results for scene, results in both.items() if 1 in results and len(results) > 1}


def _label(scene: str, result: Result) -> str:
    size = nodes(scene, result) if scene.startswith("growth/") else None
    return f"net of {size:,} nodes" if size else label(scene)


def _thread_curves(run: Run, value: Callable[[float, int], float], ideal: Callable[[int], float]) -> list[Series]:
    """A curve over threads for each scene, as many as have colours of their own, and the ideal."""
    shown = list(_threaded(run).items())[:MOST_CURVES]
    curves = [Series(_label(scene, results[1]), _curve_colour(i),
                     [[n, rounded(value(speed(result) / speed(results[1]), n))] for n, result in results.items()])
              for i, (scene, results) in enumerate(shown)]
    return [*curves, Series("ideal", GREY, [[n, ideal(n)] for n in _thread_counts(run)], dashed=True)]


def _thread_counts(run: Run) -> list[int]:
    return sorted({n for results in _threaded(run).values() for n in results})


def _scaling(run: Run, title: str, caption: str, curves: list[Series], y: dict[str, object]) -> Figure:
    scenes = _threaded(run)
    if len(scenes) > MOST_CURVES:
        caption += f" Shown are {MOST_CURVES} of {len(scenes)} scenes; the table has all."
    rows: list[Row] = []
    for scene, results in scenes.items():
        for threads, result in results.items():
            ratio = speed(result) / speed(results[1])
            rows.append([_label(scene, result), threads, ratio, 100 * ratio / threads, _step_ns(scene, result),
                         counter(result, "handover_ns") or run.handover_ns()])
    return Figure(title, caption, measure("^(case|growth|machine)/"),
                  ["scene", "threads", "speed-up", "efficiency, %", "step, ns", "hand-over, ns"], rows,
                  lines(curves, {"title": "threads", "log": True, "ticks": _thread_counts(run)}, y))


def speed_up(run: Run) -> Figure:
    """Speed-up over one thread, with the ideal."""
    return _scaling(run, "Speed-up with threads", "The closer to the dashed line the better; below 1 threads do harm.",
                    _thread_curves(run, lambda ratio, n: ratio, lambda n: n),
                    {"title": "speed-up over 1 thread", "log": True, "ticks": _thread_counts(run)})


def efficiency(run: Run) -> Figure:
    """Speed-up for each thread, with the ideal."""
    return _scaling(run, "Efficiency of threads",
                    "100 % means that each thread does as much as one alone; above half is good.",
                    _thread_curves(run, lambda ratio, n: 100 * ratio / n, lambda n: 100),
                    {"title": "speed-up divided by threads, %"})


def _step_ns(scene: str, result: Result) -> float | None:
    """Length of a step that each thread does. Whole runs have none: they hold start-up and output, and phases whose
    elements differ. Nor has free flight: it does many steps at once, and threads do not meet in it."""
    if scene.endswith("/whole") or result.counters.get("flown_share", 0) > MOST_FLOWN:
        return None
    steps, elements, each = (result.counters.get("steps_per_second"), result.counters.get("elements"),
                             per_update_ns(result))
    if steps:
        return 1e9 / steps
    return elements * each if elements and each else None


def hand_over(run: Run) -> Figure:
    """Length of a step with one thread beside one hand-over: what a second thread has to beat."""
    handover = run.handover_ns()
    scenes = by_scene([*of_suite(run, "case"), *of_suite(run, "growth")])
    steps: list[tuple[str, float, float, float]] = []
    for scene, results in scenes.items():
        length = _step_ns(scene, results[1]) if 1 in results else None
        beside = handover and length and (counter(results[1], "handover_ns") or handover)
        if length and beside:
            steps.append((_label(scene, results[1]), length, beside, length / beside))
    rows = sorted(steps, key=lambda step: step[1])
    series = [Series("a step with 1 thread", 0, column(rows, 1)),
              Series("a hand-over between 2 threads", 1, column(rows, 2))]
    return Figure(
        "A step beside a hand-over",
        "Threads meet in each step, so steps must last many hand-overs for threads to pay; short hand-overs are good. "
        "Left out are whole runs, and phases that fly freely for more than 1 % of their steps, many of them at once.",
        measure("^(case|growth|machine)/"), ["scene", "step, ns", "hand-over, ns", "hand-overs in a step"], rows,
        bars(first_cells(rows), series, "time, ns", log=True))
