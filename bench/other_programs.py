"""Run times of other programs, as bench/README.md gives them under "Others": measured once, outside this suite, on one
core of a Zen 5 server with AVX-512. Steps are of 1e-6 s, in scenes that Cinch's benchmarks have as well."""
from __future__ import annotations

from dataclasses import dataclass

STEP_S = 1e-6
MACHINE = "one core of a Zen 5 server"


def minutes_of_step(milliseconds: float) -> float:
    """Minutes per simulated second of steps that take so long each."""
    return milliseconds * 1e-3 / STEP_S / 60


@dataclass(frozen=True)
class Scene:
    """One scene, Cinch's benchmark of it, and the others' minutes of run time per simulated second."""

    words: str
    benchmark: str  # without what names.py drops
    minutes: dict[str, float]
    threads: int = 1
    elements: int | None = None  # where the benchmark does not count them


SCENES = [
    Scene("chain of 200 elements", "element/chain_with_ledger/200", {
        "MuJoCo, springs": 0.50, "MoorDyn": 0.38, "Project Chrono": 0.73, "LAMMPS": 0.025, "Bullet": 0.35,
        "YADE": 0.36}, elements=200),
    Scene("net of 781 nodes", "element/net_of_781_nodes", {
        "MuJoCo, springs": 2.0, "MoorDyn": 2.6, "Project Chrono": 3.3}, elements=880),
    Scene("net of 1,737 nodes", "element/net_of_1737_nodes", {"Bullet": 3.1, "YADE": 4.5, "LAMMPS": 0.21}),
    Scene("net of 10^5 nodes", "growth/99856", {"LAMMPS": minutes_of_step(1.3)}),
    Scene("net of 10^6 nodes", "growth/1000000", {"LAMMPS": minutes_of_step(19.9)}),
    Scene("net of 10^6 nodes, 2 threads", "growth/1000000", {"LAMMPS, 2 ranks": minutes_of_step(10.3)}, threads=2)]
