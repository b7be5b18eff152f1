"""The figure of the force reduction: one net's forces summed and its nodes moved in several ways."""
from __future__ import annotations

from page.figure import Figure, Row, Series, bars, by_scene, column, first_cells, measure, of_suite, per_update_ns
from stored_run import Run

WAYS = {"solver": ("Cinch", 0), "gather": ("gather", 2), "coloured_scatter": ("coloured scatter", 1),
        "private_sums": ("private sums", 3)}


def figure(run: Run) -> Figure:
    """Time of one element and step, by size and threads."""
    times: dict[tuple[int, int], dict[str, float | None]] = {}
    for scene, results in by_scene(of_suite(run, "reduction")).items():
        _, way, *size = scene.split("/")
        for threads, result in results.items():
            nodes = int(result.counters.get("nodes", float(size[0]) if size and size[0].isdecimal() else 0))
            times.setdefault((nodes, threads), {})[way] = per_update_ns(result)
    rows: list[Row] = [(f"{nodes:,} nodes, {threads} thread{'s' * (threads > 1)}", *(ways.get(way) for way in WAYS))
                       for (nodes, threads), ways in sorted(times.items())]
    series = [Series(words, colour, column(rows, i)) for i, (words, colour) in enumerate(WAYS.values(), 1)]
    return Figure(
        "Ways to sum forces to nodes",
        "Shorter is better: the same net's forces computed and summed and its nodes moved. Three plain ways with index "
        "arrays, by one law: a gather adds up at each node what its elements have written, a scatter adds each element's "
        "force to its ends, colour by colour, private sums are arrays of stretches of elements, added up afterwards. Cinch "
        "gathers without index arrays, by a law that costs more.",
        measure("^reduction/"), ["net", *(f"{words}, ns" for words, _ in WAYS.values())], rows,
        bars(first_cells(rows), series, "time per element and step, ns"))
