"""Runs as Google Benchmark writes them, made up for the tests: two machines, three commits, 1 to 16 threads.

Every benchmark of the dashboard is there. Times follow simple laws (Amdahl's, caches that net after net outgrows), so
that the pages made of them look like real ones.
"""
from __future__ import annotations

import json
import random
import sys
import tempfile
import zlib
from pathlib import Path
from typing import Any, Iterator

ROOT = Path(__file__).resolve().parents[2]
BENCH = ROOT / "bench"
sys.path.insert(0, str(BENCH))

THREADS = (1, 2, 4, 8, 16)
MACHINES = {"lab": "Example CPU 8-Core", "cluster": "Example CPU 64-Core"}
COMMITS = {"aaaaaaaaaaaa": "2026-01-10T12:00:00+01:00", "bbbbbbbbbbbb": "2026-02-20T12:00:00+01:00",
           "cccccccccccc": "2026-04-01T12:00:00+02:00"}

Entry = dict[str, Any]


ONE_THREAD = ("element/", "kernel/", "absent/")  # suites that go by the processor's time


def entries(name: str, seconds: float, counters: dict[str, float], repetitions: int,
            noise: random.Random) -> Iterator[Entry]:
    """The single measurements of one benchmark, then two of the aggregates that Google Benchmark adds. The machine is
    busy: one thread has the processor for 80 % of the time."""
    appended, busy = ("", 1.25) if name.startswith(ONE_THREAD) else ("/real_time", 1.0)
    base = {"run_name": name + appended, "repetitions": repetitions, "threads": 1, "time_unit": "ms",
            **({"label": state_hash(name)} if name.startswith("case/") else {})}
    times = []
    for index in range(repetitions):
        times.append(1e3 * seconds * (1 + 0.02 * noise.random()))
        yield {**base, "name": name + appended, "run_type": "iteration", "repetition_index": index, "iterations": 10,
               "real_time": busy * times[-1], "cpu_time": times[-1], **counters}
    if repetitions > 1:
        yield {**base, "name": name + appended + "_median", "run_type": "aggregate", "aggregate_name": "median",
               "aggregate_unit": "time", "iterations": repetitions, "real_time": busy * times[0], "cpu_time": times[0]}
        yield {**base, "name": name + appended + "_cv", "run_type": "aggregate", "aggregate_name": "cv",
               "aggregate_unit": "percentage", "iterations": repetitions, "real_time": 0.01, "cpu_time": 0.01}


def state_hash(name: str) -> str:
    """The same for each number of threads, as the solver's bits are."""
    return f"0x{zlib.crc32(name.rsplit('/threads:', 1)[0].encode()):016x}"


def speed_up(threads: int, serial: float) -> float:
    """Amdahl's law."""
    return 1 / (serial + (1 - serial) / threads)


Benchmark = tuple[str, float, dict[str, float]]

CASES = {"ring_pull/whole": (200, 10e-3, 0.9), "edge_closure/whole": (2800, 0.15, 0.4),
         "capture/whole": (2300, 0.2, 0.3), "capture/deployment": (1800, 0.1, 0.5),
         "capture/closing": (2300, 0.25, 0.2), "large_capture/closing/long": (72000, 12.0, 0.05)}
ONE_THREAD_CASES = {"capture/closing_without_ledger": (2300, 0.24), "ring_pull/sliding": (20, 1e-3),
                    "edge_closure/closing": (460, 0.03), "capture/sliding_until_closed": (250, 0.09)}


def of_cases() -> Iterator[Benchmark]:
    every = {**CASES, **{case: (*size, 1.0) for case, size in ONE_THREAD_CASES.items()}}
    for case, (elements, minutes, serial) in every.items():
        for threads in THREADS if case in CASES else (1,):
            gain = speed_up(threads, serial)
            meeting = 0.0 if threads == 1 else min(0.6, serial)
            steps = {} if case.endswith("/whole") else {
                "steps_per_second": gain * 1.25e5 * (1.04 if "without" in case else 1),
                "flown_share": 0.9 if "deployment" in case else 0.004}
            shares = {"contacts": 0.3, "axial_forces": 0.3, "gather_and_move": 0.2, "broadphase": 0.1, "observe": 0.05}
            yield f"case/{case}/threads:{threads}", minutes / gain, {
                "minutes_per_simulated_second": minutes / gain, "elements": elements, "nodes": elements * 0.9,
                "element_updates_per_second": gain * 3e8, "omp_threads": threads, "handover_ns": 180.0,
                "share_threads_meeting": meeting, **steps,
                **{f"share_{stage}": share * (1 - meeting) for stage, share in shares.items()}}


def of_growth() -> Iterator[Benchmark]:
    for nodes in (1_024, 10_000, 99_856, 315_844, 1_000_000):
        for threads in THREADS:
            cached = nodes < 30_000
            gain = speed_up(threads, 2e3 / nodes) if cached else min(speed_up(threads, 0.02), 4 + nodes / 5e5)
            updates = gain * (6e8 if cached else 3e8)
            name = f"growth/{nodes}" + ("/long" if nodes == 1_000_000 else "")
            yield f"{name}/threads:{threads}", 0.05 / gain, {
                "nodes": nodes, "elements": 1.05 * nodes, "element_updates_per_second": updates,
                "bytes_per_second": 100 * updates,
                "fraction_of_triad": 1.6 + 0.1 * threads if cached else 0.8 + 0.01 * threads,
                "omp_threads": threads, "bytes_per_item": 290 + 2e5 / nodes + 10 * threads}


def of_parts() -> Iterator[Benchmark]:
    for threads in THREADS:
        yield f"machine/triad/threads:{threads}", 0.02, {"bytes_per_second": 2e10 * min(threads, 4)}
    yield "machine/handover", 2e-4, {"handover_ns": 180.0}
    for elements in (200, 2000):
        for kind, share in (("bare", 1.0), ("chain", 0.93), ("chain_with_ledger", 0.7)):
            fraction = {} if kind == "bare" else {"fraction_of_yardstick": share}
            yield f"element/{kind}/{elements}", 1e-3, {"element_updates_per_second": 1e9 * share, **fraction}
    for nodes, elements in ((781, 880), (1737, 2016)):
        yield f"element/net_of_{nodes}_nodes", 1e-3, {"element_updates_per_second": 3e8, "elements": elements,
                                                      "nodes": nodes}
    for kernel, items in (("axial_force", 8e8), ("ring_distance", 3e8), ("node_gather", 1e9)):
        yield f"kernel/{kernel}/4096", 1e-3, {"items_per_second": items, "bytes_per_second": 60 * items}
    for feature, cost in (("rings", 1.001), ("balls", 1.004), ("ledger", 0.998), ("probes", 1.02)):
        yield f"absent/{feature}/with", 1e-3, {"element_updates_per_second": 9e8 / cost}
        yield f"absent/{feature}/without", 1e-3, {"element_updates_per_second": 9e8}
    for scene, seconds in (("ring_pull", 2e-3), ("capture", 0.06), ("large_capture", 1.4), ("net_1000000/long", 1.1)):
        yield f"startup/{scene}", seconds, {"omp_threads": 16 if "000" in scene else 1}  # as many as pay
    for what in ("frame", "report"):
        yield f"output/{what}", 0.03, {"bytes_per_second": 4e8}


def of_ways() -> Iterator[Benchmark]:
    for nodes in (1_024, 99_856):
        for threads in THREADS:
            for way, share in (("solver", 2.0), ("gather", 1.0), ("coloured_scatter", 0.6), ("private_sums", 0.8 / threads**0.5)):
                yield f"reduction/{way}/{nodes}/threads:{threads}", 0.02, {
                    "element_updates_per_second": 4e8 * share * speed_up(threads, 0.1), "nodes": nodes,
                    "omp_threads": threads}
    for elements in (1_000, 10_000, 100_000):
        yield f"broadphase/{elements}", 1e-7 * elements, {
            "pairs_tested": 40 * elements, "pairs_kept": 3 * elements, "elements": elements, "items_per_second": 1e7}


def google_json(machine: str = "lab", commit: str = "aaaaaaaaaaaa", *, slower: dict[str, float] | None = None,
                repetitions: int = 5, seed: int = 1, only: str = "", **context: str) -> dict[str, Any]:
    """A whole run. `slower` multiplies times by the benchmark's name, `only` keeps names that begin so."""
    noise, factors = random.Random(seed), slower or {}
    groups = (of_cases(), of_growth(), of_parts(), of_ways())
    benchmarks = [entry for group in groups for name, seconds, counters in group
                  if name.startswith(only)
                  for entry in entries(name, seconds * factors.get(name, 1), counters, repetitions, noise)]
    about = {"date": COMMITS.get(commit, "2026-05-01T12:00:00+00:00"), "host_name": "h", "num_cpus": 16,
             "machine": machine, "cpu": MACHINES.get(machine, "CPU"), "cores": "16", "isa": "v3",
             "compiler": "GNU 12.2.0", "build_type": "Release", "commit": commit, "dirty": "no", "mode": "full",
             "commit_date": COMMITS.get(commit, "2026-05-01T12:00:00+00:00")}
    return {"context": about | context, "benchmarks": benchmarks}


def gave_up(name: str, why: str) -> Entry:
    """What a benchmark leaves behind that calls SkipWithError."""
    return {"name": name, "run_type": "iteration", "error_occurred": True, "error_message": why, "real_time": 0.0}


def store(folder: Path, name: str, data: dict[str, Any]) -> Path:
    """Writes a run as bench/run would."""
    path = folder / "runs" / f"{name}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(data), encoding="utf-8")
    return path


def run_of(data: dict[str, Any]) -> Any:
    """A stored run, read back."""
    from stored_run import read_run
    with tempfile.TemporaryDirectory() as folder:
        return read_run(store(Path(folder), "run", data))


def store_history(folder: Path) -> list[Path]:
    """Three commits on each of two machines, the second slower for one benchmark; the last is lab's latest."""
    runs = []
    for machine in reversed(MACHINES):
        for seed, commit in enumerate(COMMITS):
            slower = {"case/capture/whole/threads:1": 1 - 0.2 * seed} if machine == "lab" else {
                "case/capture/whole/threads:1": 0.8 + 0.03 * seed}
            runs.append(store(folder, f"{machine}-{commit}", google_json(machine, commit, slower=slower, seed=seed)))
    return runs


INSTRUCTIONS: dict[str, Any] = {
    "machine": "desk", "cpu": "Example CPU 2-Core", "commit": "ffffffffffff", "isa": "v3", "date": "2026-04-02",
    "features": {"rings": {"counted": 1001000, "stripped": 1000000},
                 "balls": {"counted": 1000000, "stripped": 1000000}}}


def of_study() -> dict[str, Any]:
    """A study of one problem as bench/study writes it: two methods, one of them with the paper's choice, and a run that
    failed."""
    def run(method: str, elements: int, error: float, seconds: float, papers: bool = False) -> dict[str, Any]:
        return {"series": f"{method}, step 1e-06 s", "method": method, "elements": elements, "step_s": 1e-6,
                "closing_step_s": 1e-6,
                "papers_choice": papers, "runs": 1, "errors": {"error": error, "peak_force": 0.2},
                "but_for_the_step": f"{method}, {elements} elements", "energy_residual": 1e-4,
                "seconds_per_simulated_second": seconds}
    runs = [run("contact", n, 4 / n, n / 400, n > 50) for n in (50, 100, 200)]
    runs += [run("sliding", n, 0.05 / n, n / 2000) for n in (6, 12, 24)]
    runs[3]["energy_residual"] = 2e-4
    runs.append({"series": "sliding, step 1e-06 s", "method": "sliding", "elements": 2, "step_s": 0.0,
                 "closing_step_s": 0.0,
                 "papers_choice": False, "runs": 1, "failure": "error: at t = 1 s <something> went wrong"})
    best = [{"error": 0.1, "run": 3}, {"error": 0.0001, "run": None, "why": "the reference decides nothing so small"}]
    measures = {"error": {"reference_error": 0.0004, "chaotic": False},
                "peak_force": {"reference_error": 0.05, "chaotic": True}}
    problem = {"name": "pull", "title": "A pull (Sec. 5.1)", "measure": "distance", "reference_error": 0.0004,
               "runs": runs, "best": best, "best_of_small_residual": [{"error": 0.1, "run": 4}, best[1]],
               "measures": measures, "orders": {"contact, step 1e-06 s": 1.0},
               "step_orders": {"sliding, 6 elements": 2.0}}
    return {"version": "0.1.0", "commit": "dddddddddddd", "compiler": "GNU", "isa": "v4", "machine": "desk",
            "cpu": "Example CPU 2-Core", "problems": [problem]}


def of_stability() -> dict[str, Any]:
    """A matrix as bench/stability writes it: a cell or two of each group that has a figure, one that FAILED."""
    def cell(group: str, parameter: str, value: str, verdict: str, residual: float, **place: float) -> dict[str, Any]:
        return {"group": group, "parameter": parameter, "value": value, "must": "held or stopped", "verdict": verdict,
                "residual": residual, "steps": 1000, "message": "" if verdict == "held" else "error: at <t>",
                "place": place}
    cells = [cell("stiffness", "modulus, element length", f"{modulus:g} Pa, {length:g} m", "held",
                  1e-5 * length * modulus**0.1, modulus_Pa=modulus, element_m=length)
             for length in (0.001, 0.1) for modulus in (1e5, 1e7, 1e9)]
    cells += [cell("slack and taut", f"{way}, damping ratio, step", f"0, {step}", "held" if step < 0.5 else "stopped",
                   step**4 * (1 + 2 * (way == "whipped")), damping=0, step_fraction=step)
              for way in ("whipped", "released slack") for step in (0.2, 0.4, 0.8)]
    cells += [cell("motion", "mass on a ball, speed", f"{speed:g} m/s", "held" if speed < 100 else "FAILED",
                   1e-4 * (speed - 0.1), speed_m_s=speed) for speed in (0.1, 1.0, 10.0, 100.0)]
    groups = [{"name": name, **{words.lower(): sum(cell["group"] == name and cell["verdict"] == words for cell in cells)
                                for words in ("held", "stopped", "FAILED")}}
              for name in ("stiffness", "slack and taut", "motion")]
    return {"version": "0.1.0", "commit": "eeeeeeeeeeee", "compiler": "GNU", "isa": "v3", "mode": "quick",
            "groups": groups, "cells": cells}


def found() -> Any:
    """What the other programs have found, for the page."""
    from dashboard import Found
    return Found(INSTRUCTIONS, of_study(), of_stability())


def store_page(folder: Path) -> Path:
    """A page with every figure filled, made by the programs as a user would."""
    import dashboard
    import history
    from stored_run import read_run
    runs = store_history(folder)
    for path in runs:
        history.append(folder / "history.jsonl", read_run(path))
    page = folder / "dashboard.html"
    page.write_text(dashboard.render(read_run(runs[-1]), history.read(folder / "history.jsonl"),
                                     dashboard.CHART_JS.read_text(encoding="utf-8"), found()),
                    encoding="utf-8")
    return page


if __name__ == "__main__":  # a page to look at: tests/bench/sample.py FOLDER
    print(store_page(Path(sys.argv[1])))
