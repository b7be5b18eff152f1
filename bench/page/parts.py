"""Figures of the parts of a step and of what is around it: element update, kernels, output."""
from __future__ import annotations

from page.figure import GREY, Figure, Row, Series, bars, column, counter, first_cells, measure, of_suite, per_update_ns
from stored_run import Result, Run


KINDS = {"bare": ("yardstick", GREY), "chain": ("Cinch", 0), "chain_with_ledger": ("Cinch, with energy ledger", 1)}


def element(run: Run) -> Figure:
    """The solver's element update beside two bare loops that do nothing else; small nets below, which have none."""
    chains: dict[str, dict[str, Result]] = {}
    nets: list[Row] = []
    for name, result in of_suite(run, "element"):
        if len(name.parts) == 2 and per_update_ns(result):
            chains.setdefault(name.parts[1], {})[name.parts[0]] = result
        elif len(name.parts) == 1 and per_update_ns(result):
            nets.append((name.parts[0].replace("_", " "), None, None, per_update_ns(result), None, None))
    sizes = sorted(chains, key=lambda size: (len(size), size))
    rows: list[Row] = [(f"chain, {size} elements", *(_time(chains[size], kind) for kind in KINDS),
                        *(_of_yardstick(chains[size], kind) for kind in ("chain", "chain_with_ledger")))
                       for size in sizes] + nets
    series = [Series(words, colour, column(rows, i)) for i, (words, colour) in enumerate(KINDS.values(), 1)]
    return Figure(
        "Element update beside its yardstick",
        "Shorter is better; the yardstick is the same arithmetic in bare loops: something to compare with, no bound. "
        "Nets have none: their mesh sides of several elements are short runs.",
        measure("^element/"),
        ["scene", "yardstick, ns", "Cinch, ns", "with ledger, ns", "Cinch's speed, % of yardstick",
         "with ledger, % of yardstick"],
        rows, bars(first_cells(rows), series, "time per element and step, ns"))


def _time(kinds: dict[str, Result], kind: str) -> float | None:
    return per_update_ns(kinds[kind]) if kind in kinds else None


def _of_yardstick(kinds: dict[str, Result], kind: str) -> float | None:
    """Share of the yardstick's speed in per cent, from the counter or from the two speeds."""
    if kind not in kinds:
        return None
    counted = counter(kinds[kind], "fraction_of_yardstick", 100)
    if counted is not None or "bare" not in kinds:
        return counted
    return 100 * (per_update_ns(kinds["bare"]) or 0) / (per_update_ns(kinds[kind]) or 1)


def kernels(run: Run) -> Figure:
    """Each kernel on its own, on arrays of the size in its name."""
    rows: list[Row] = []
    for name, result in of_suite(run, "kernel"):
        items = result.counters.get("element_updates_per_second") or result.counters.get("items_per_second")
        if items:
            rows.append([", ".join(name.parts).replace("_", " "), 1e9 / items,
                         counter(result, "bytes_per_second", 1e-9)])
    return Figure(
        "Kernels",
        "Time that one kernel takes for one item (element, node or near pair); shorter is better, on a logarithmic "
        "scale.",
        measure("^kernel/"), ["kernel, items", "ns per item", "GB/s"], rows,
        bars(first_cells(rows), [Series("kernel", 0, column(rows, 1))], "time per item, ns", log=True))


def around(run: Run) -> Figure:
    """What is not stepping: start-up of scenes and output."""
    rows: list[Row] = []
    for suite, words in (("startup", "start-up"), ("output", "output")):
        for name, result in of_suite(run, suite):
            rows.append([f"{words}: {', '.join(name.parts)}", 1e3 * result.median,
                         counter(result, "bytes_per_second", 1e-6)])
    return Figure(
        "Start-up and output",
        "Time before the first step of a scene, and for each thing written; shorter is better.",
        measure("^(startup|output)/"), ["what", "ms", "MB/s"], rows,
        bars(first_cells(rows), [Series("time", 3, column(rows, 1))], "time, ms", log=True))
