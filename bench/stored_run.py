"""Reads a stored run: Google Benchmark's JSON, with the repetitions of each benchmark gathered.

Times become seconds, names are normalised, and entries are checked here once, so that nothing behind this file has to
know Google Benchmark's format.
"""
from __future__ import annotations

import json
import math
import statistics
from dataclasses import dataclass, field
from datetime import datetime, timezone
from pathlib import Path
from typing import Any, Iterable

import names
from command_line import BadInput

WALL, PROCESSOR = "wall", "processor"  # clocks
MADE_WITH = ("isa", "compiler", "build_type", "mode")  # with the machine: times of others are never joined

_SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}

# Google Benchmark's own keys of an entry; every other number is a counter.
_OWN_KEYS = {
    "name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions", "repetition_index",
    "threads", "iterations", "real_time", "cpu_time", "time_unit", "label", "aggregate_name", "aggregate_unit",
    "error_occurred", "error_message", "big_o", "rms", "cpu_coefficient", "real_coefficient", "complexity_n"}


@dataclass(frozen=True)
class Result:
    """One benchmark of one run: a time for each repetition, counters as medians over the repetitions."""

    name: str
    seconds: tuple[float, ...]  # per iteration; empty when the benchmark gave up
    clock: str = WALL  # of these seconds
    counters: dict[str, float] = field(default_factory=dict)
    error: str = ""
    labels: tuple[str, ...] = ()  # each once: state hashes, so more than one means that repetitions came to other bits

    @property
    def median(self) -> float:
        return statistics.median(self.seconds)

    @property
    def omp_threads(self) -> int | None:
        """OpenMP's threads; Google Benchmark's own field "threads" counts something else and is always 1 here."""
        counted = self.counters.get("omp_threads")
        return int(counted) if counted is not None else names.parse(self.name).threads


@dataclass(frozen=True)
class Run:
    """One run of the benchmarks on one machine, perhaps with results of older ones (newest.py)."""

    path: Path
    context: dict[str, Any]
    results: dict[str, Result]
    older: dict[str, Run] = field(default_factory=dict)  # by the names of the benchmarks that come from them

    @property
    def id(self) -> str:
        return self.path.stem

    @property
    def date(self) -> str:
        """When it began, UTC."""
        return utc(str(self.context.get("date", "")))

    @property
    def machine_id(self) -> str:
        """Name and CPU: times of different ids are never compared without a warning."""
        return f"{self.about('machine', self.about('host_name'))}, {self.about('cpu')}"

    def about(self, key: str, default: str = "unknown") -> str:
        """A word of the context; runs that bench/run has not made lack some."""
        return str(self.context.get(key) or default)

    @property
    def commit(self) -> str:
        return self.about("commit") + (" with changes" if self.about("dirty") == "yes" else "")

    def commit_of(self, benchmark: str) -> str:
        """The commit that a benchmark was measured at."""
        return self.older.get(benchmark, self).commit

    def parsed(self) -> list[tuple[names.Name, Result]]:
        """All results that have times, with their names in parts."""
        return [(names.parse(result.name), result) for result in self.results.values() if result.seconds]

    def handover_ns(self) -> float | None:
        """Median time for one thread to hand over to another: says what state the machine was in."""
        own = [r for r in self.results.values() if names.parse(r.name).scene == "machine/handover"]
        found = [r.counters["handover_ns"] for r in own or self.results.values() if "handover_ns" in r.counters]
        return statistics.median(found) if found else None


def utc(date: str) -> str:
    """An ISO date with any offset as UTC, to the second; what is no date stays as it is."""
    try:
        return datetime.fromisoformat(date).astimezone(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    except ValueError:
        return date


def parse_json(text: str, where: str, first_line: int = 1) -> Any:
    """JSON, or BadInput with file, line and column."""
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise BadInput(f"{where}:{first_line + error.lineno - 1}:{error.colno}: not JSON: {error.msg}") from None
    except RecursionError:
        raise BadInput(f"{where}: not Google Benchmark's JSON: nested too deeply") from None


def read_text(path: Path) -> str:
    """A whole text file; what keeps it from being read becomes one line."""
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise BadInput(f"{path}: not text: byte {error.start} is no UTF-8") from None


def read_run(path: Path) -> Run:
    """Reads and checks Google Benchmark's JSON."""
    data = parse_json(read_text(path), str(path))
    if not isinstance(data, dict) or not isinstance(data.get("benchmarks"), list):
        raise BadInput(f"{path}: not Google Benchmark's JSON: there is no list \"benchmarks\"")
    if not isinstance(data.get("context"), dict):
        raise BadInput(f"{path}: not Google Benchmark's JSON: there is no object \"context\"")
    for index, entry in enumerate(data["benchmarks"]):
        _check(entry, f"{path}: not Google Benchmark's JSON: benchmarks[{index}]")
    results = _gather(data["benchmarks"])
    if not results:
        raise BadInput(f"{path}: holds no benchmark")
    return Run(path, data["context"], results)


def _check(entry: Any, where: str) -> None:
    if not isinstance(entry, dict) or not isinstance(entry.get("name"), str):
        raise BadInput(f"{where} has no text \"name\"")
    if entry.get("error_occurred") or "big_o" in entry or "rms" in entry:
        return
    for key in ["real_time", *(["cpu_time"] if "cpu_time" in entry else [])]:
        time = entry.get(key)
        if not isinstance(time, (int, float)) or isinstance(time, bool) or not math.isfinite(time):
            raise BadInput(f"{where} has no number \"{key}\"")
    if entry.get("aggregate_unit") != "percentage" and entry.get("time_unit") not in _SECONDS:
        raise BadInput(f"{where} has no \"time_unit\" of {', '.join(_SECONDS)}")


def _gather(entries: list[dict[str, Any]]) -> dict[str, Result]:
    """Repetitions by benchmark, in the file's order. Medians stand in where the file holds aggregates only."""
    single: dict[str, list[dict[str, Any]]] = {}
    medians: dict[str, list[dict[str, Any]]] = {}
    for entry in entries:
        name = names.normalise(entry.get("run_name") or entry["name"])
        if entry.get("run_type", "iteration") == "iteration":
            single.setdefault(name, []).append(entry)
        elif entry.get("aggregate_name") == "median":
            medians.setdefault(name, []).append(entry)
    return {name: _result(name, group) for name, group in {**medians, **single}.items()}


def _result(name: str, entries: list[dict[str, Any]]) -> Result:
    """One benchmark from its repetitions; those that gave up are left out as long as one did not."""
    done = [entry for entry in entries if not entry.get("error_occurred")]
    if not done:
        return Result(name, (), error=str(entries[0].get("error_message") or "gave up"))
    clock = PROCESSOR if all(_by_processor(entry) for entry in done) else WALL
    key = "cpu_time" if clock == PROCESSOR else "real_time"
    seconds = tuple(entry[key] * _SECONDS[entry["time_unit"]] for entry in done)
    labels = dict.fromkeys(entry["label"] for entry in done if isinstance(entry.get("label"), str) and entry["label"])
    return Result(name, seconds, clock, _median_counters(done), labels=tuple(labels))


def _by_processor(entry: dict[str, Any]) -> bool:
    """Google Benchmark goes by the processor's time, in counters too, unless the name tells of another clock: a busy
    machine then does not slow a benchmark down."""
    parts = (entry.get("run_name") or entry["name"]).split("/")
    return "cpu_time" in entry and not {"real_time", "manual_time"} & set(parts)


def _median_counters(entries: Iterable[dict[str, Any]]) -> dict[str, float]:
    """Counters that are no finite number cannot be stored as JSON and say nothing: they are left out."""
    values: dict[str, list[float]] = {}
    for entry in entries:
        for key, value in entry.items():
            if key in _OWN_KEYS or isinstance(value, bool) or not isinstance(value, (int, float)):
                continue
            if math.isfinite(value):
                values.setdefault(key, []).append(value)
    return {key: statistics.median(list_of) for key, list_of in values.items()}
