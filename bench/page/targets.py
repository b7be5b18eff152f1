"""The project's targets, each beside what this run has measured of it."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Callable

from page import absent, bits
from page.figure import Badge, Figure, Row, by_scene, counter, measure, per_update_ns
from page.scaling import nodes, speed
from stored_run import Result, Run
from text import number

CLOSING, LARGE = "case/capture/closing", "case/large_capture/closing"
UNTIL_CLOSED = "case/capture/sliding_until_closed"
SHORT_HANDOVER_NS = 100  # below it two threads of a closing capture are to gain, above they must not lose


@dataclass(frozen=True)
class Finding:
    """What was measured, in words, and whether it is what was aimed at."""

    words: str
    met: bool


class Measured:
    """A run and the instructions of absent features, by what targets ask for. All answers are None where the run
    lacks them."""

    def __init__(self, run: Run, instructions: absent.Instructions | None) -> None:
        self.run, self.instructions = run, instructions
        self.scenes = by_scene(run.parsed())

    def result(self, scene: str, threads: int = 1) -> Result | None:
        return self.scenes.get(scene, {}).get(threads)

    def counter(self, scene: str, key: str, threads: int = 1, factor: float = 1.0) -> float | None:
        result = self.result(scene, threads)
        return counter(result, key, factor) if result else None

    def run_time(self, scene: str, threads: int = 1) -> float | None:
        """Seconds of run time for a simulated second."""
        return self.counter(scene, "minutes_per_simulated_second", threads, 60)

    def update_ns(self, scene: str) -> float | None:
        result = self.result(scene)
        return per_update_ns(result) if result else None

    def milliseconds(self, scene: str) -> float | None:
        """With as many threads as the program takes for it."""
        results = self.scenes.get(scene, {})
        return 1e3 * min(result.median for result in results.values()) if results else None


Find = Callable[[Measured], "Finding | None"]
Value = Callable[[Measured], "float | None"]


@dataclass(frozen=True)
class Target:
    """One row: the part, what was aimed at, how to find what came of it, and what measures it."""

    part: str
    goal: str
    find: Find
    command: str


def at_most(limit: float, unit: str, value: Value) -> Find:
    return _bounded(value, unit, lambda found: found <= limit)


def at_least(limit: float, unit: str, value: Value) -> Find:
    return _bounded(value, unit, lambda found: found >= limit)


def _bounded(value: Value, unit: str, holds: Callable[[float], bool]) -> Find:
    def find(measured: Measured) -> Finding | None:
        found = value(measured)
        return None if found is None else Finding(f"{number(found)} {unit}".rstrip(), holds(found))
    return find


def ratio(over: float | None, under: float | None) -> float | None:
    return over / under if over is not None and under else None


def _beside_yardstick(elements: int) -> Value:
    return lambda m: ratio(1, m.counter(f"element/chain/{elements}", "fraction_of_yardstick"))


def _contacts(m: Measured) -> float | None:
    """Microseconds a step."""
    return ratio(m.counter(CLOSING, "share_contacts", factor=1e6), m.counter(CLOSING, "steps_per_second"))


def _ledger(m: Measured) -> float | None:
    """Extra time of a step with the ledger, in per cent."""
    without = m.counter("case/capture/closing_without_ledger", "steps_per_second")
    times = ratio(without, m.counter(CLOSING, "steps_per_second"))
    return 100 * (times - 1) if times else None


def _efficiency(threads: int) -> Value:
    def value(m: Measured) -> float | None:
        one, more = m.result(LARGE), m.result(LARGE, threads)
        return speed(more) / speed(one) / threads if one and more else None
    return value


def _on_two_threads(m: Measured) -> Finding | None:
    """Where a hand-over is long, two threads cannot gain in so short a step."""
    one, two = m.run_time(CLOSING), m.run_time(CLOSING, 2)
    handover = m.counter(CLOSING, "handover_ns", 2) or m.run.handover_ns()
    if two is None or handover is None:
        return None
    beside = f"hand-over {number(handover)} ns"
    if handover <= SHORT_HANDOVER_NS:
        return Finding(f"{number(two)} s/s, {beside}", two <= 1.0)
    return Finding(f"{number(two / one)} of one thread's time, {beside}", two <= one) if one else None


def _growth(m: Measured) -> Finding | None:
    """The largest net against that of 10^3 nodes, with one thread."""
    nets = {nodes(scene, results[1]) or 0: per_update_ns(results[1])
            for scene, results in m.scenes.items() if scene.startswith("growth/") and 1 in results}
    sizes = sorted(size for size, each in nets.items() if each and size >= 1000)
    times = ratio(nets[sizes[-1]], nets[sizes[0]]) if len(sizes) > 1 and sizes[0] < 2000 else None
    return Finding(f"{number(times)} times, at {sizes[-1]:,} nodes", times <= 1.5) if times else None


def _bits(m: Measured) -> Finding | None:
    found = bits.scenes(m.run)
    several, differing = sum(len(scene.threads) > 1 for scene in found), sum(scene.differs for scene in found)
    if differing:
        return Finding(f"{differing} of {len(found)} scenes differ", False)
    return Finding(f"the same in {several} scenes", True) if several else None


ELEMENT, IN_CLOSING, IN_LARGE = measure("^element/"), measure(f"^{CLOSING}"), measure(f"^{LARGE}")
IN_CAPTURE, IN_MILLION = measure("^case/capture/whole"), measure("^growth/1000000/")

TARGETS = [
    Target("Element update, chain of 2000", "at most 1.1 times the yardstick's time",
           at_most(1.1, "times", _beside_yardstick(2000)), ELEMENT),
    Target("Element update, chain of 200", "at most 1.1 times the yardstick's time",
           at_most(1.1, "times", _beside_yardstick(200)), ELEMENT),
    Target("Contacts, capture closing", "at most 0.35 µs a step", at_most(0.35, "µs", _contacts), IN_CLOSING),
    Target("Search for pairs, capture closing", "at most 3 % of the time",
           at_most(3, "%", lambda m: m.counter(CLOSING, "share_broadphase", factor=100)), IN_CLOSING),
    Target("Search for pairs, large_capture closing", "at most 3 % of the time",
           at_most(3, "%", lambda m: m.counter(LARGE, "share_broadphase", factor=100)), IN_LARGE),
    Target("Energy ledger, capture closing", "at most 5 % more time", at_most(5, "%", _ledger), IN_CLOSING),
    Target("Probes and peaks, capture whole", "at most 5 % of the time",
           at_most(5, "%", lambda m: m.counter("case/capture/whole", "share_observe", factor=100)), IN_CAPTURE),
    Target("Absent features", "at most 0.5 % more instructions, the worst of them",
           at_most(0.5, "%", lambda m: absent.worst(m.instructions)), absent.COMMAND),
    Target("ring_pull whole, 1 thread", "at most 0.35 s a simulated second",
           at_most(0.35, "s/s", lambda m: m.run_time("case/ring_pull/whole")), measure("^case/ring_pull/whole")),
    Target("Capture closing, 1 thread", "at most 1.7 s a simulated second",
           at_most(1.7, "s/s", lambda m: m.run_time(CLOSING)), IN_CLOSING),
    Target("Capture whole, 1 thread", "at most 2 s for its 2 s",
           at_most(2, "s", lambda m: ratio(m.run_time("case/capture/whole"), 0.5)), IN_CAPTURE),
    Target("Capture with sliding joints, until its mouth has closed", "at most 0.1 s, without output",
           at_most(0.1, "s", lambda m: ratio(m.milliseconds(UNTIL_CLOSED), 1000)), measure(f"^{UNTIL_CLOSED}")),
    Target("Capture closing, 2 threads", f"at most 1 s a simulated second where a hand-over takes {SHORT_HANDOVER_NS} "
           "ns or less, else no slower than 1 thread", _on_two_threads, IN_CLOSING),
    Target("large_capture closing, 1 thread", "an element at most 1.3 times that of capture closing",
           at_most(1.3, "times", lambda m: ratio(m.update_ns(LARGE), m.update_ns(CLOSING))),
           measure("^case/(large_)?capture/closing")),
    Target("large_capture closing, 2 threads", "efficiency of 0.9 or more", at_least(0.9, "", _efficiency(2)),
           IN_LARGE),
    Target("large_capture closing, 16 threads", "efficiency of 0.8 or more", at_least(0.8, "", _efficiency(16)),
           f"on 16 cores: {IN_LARGE}"),
    Target("Net of 10^6 knots, 1 thread", "at least 60 % of the triad",
           at_least(60, "%", lambda m: m.counter("growth/1000000", "fraction_of_triad", factor=100)), IN_MILLION),
    Target("Growth, 1 thread", "an element of the largest net at most 1.5 times that of 10^3 nodes", _growth,
           measure("^growth/")),
    Target("Memory, net of 10^6 knots", "at most 250 bytes a node or element",
           at_most(250, "bytes", lambda m: m.counter("growth/1000000", "bytes_per_item")), IN_MILLION),
    Target("Start-up, net of 10^6 knots", "at most 2 s",
           at_most(2, "s", lambda m: ratio(m.milliseconds("startup/net_1000000"), 1000)),
           measure("^startup/net_1000000")),
    Target("Start-up, capture", "at most 10 ms", at_most(10, "ms", lambda m: m.milliseconds("startup/capture")),
           measure("^startup/capture")),
    Target("Bits", "one state hash a scene, with any number of threads", _bits, measure("^case/")),
]


def figure(run: Run, instructions: absent.Instructions | None) -> Figure:
    """A row for each target, and how many are met."""
    measured = Measured(run, instructions)
    rows: list[Row] = []
    counts = {"met": 0, "missed": 0, "not measured": 0}
    for target in TARGETS:
        finding = target.find(measured)
        verdict = "not measured" if finding is None else "met" if finding.met else "missed"
        counts[verdict] += 1
        look = {"met": "good", "missed": "poor", "not measured": "none"}[verdict]
        rows.append([target.part, target.goal, finding.words if finding else "–", Badge(verdict, look),
                     "" if finding else target.command])
    return Figure(", ".join(f"{count} {verdict}" for verdict, count in counts.items()), _caption(run), "",
                  ["part", "target", "measured", "verdict", "to measure it" if counts["not measured"] else ""], rows)


def _caption(run: Run) -> str:
    here = "" if run.about("isa") == "v4" else f" This run's instruction set is {run.about('isa')}."
    return ("Targets were set before the first line was written, for one core of a machine with AVX-512 where they name "
            f"no threads; times of other machines miss or meet them for other reasons than the code.{here}")
