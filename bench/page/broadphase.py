"""The figure of the search for near pairs."""
from __future__ import annotations

from page.figure import Figure, Row, Series, bars, column, first_cells, label, measure, of_suite, whole
from stored_run import Run


def figure(run: Run) -> Figure:
    """Time of a search for each element it goes through, and how many pairs it tests and keeps."""
    rows: list[Row] = []
    for name, result in of_suite(run, "broadphase"):
        searched = result.counters.get("items_per_second")
        if searched:
            elements, tested, kept = (result.counters.get(key) for key in ("elements", "pairs_tested", "pairs_kept"))
            rows.append((f"{whole(elements):,} elements" if elements else label(name.scene),
                         1e9 / searched, whole(tested), whole(kept),
                         tested / elements if elements and tested is not None else None,
                         100 * kept / tested if tested and kept is not None else None))
    return Figure(
        "Search for near pairs",
        "Shorter and level is good: the time of one search for each element in it. Few pairs tested for each that is "
        "kept mean boxes that fit.",
        measure("^broadphase/"),
        ["search", "ns per element", "pairs tested", "pairs kept", "tested per element", "kept, %"], rows,
        bars(first_cells(rows), [Series("search", 6, column(rows, 1))], "time of a search per element, ns"))
