"""Whether the number of threads changes bits: state hashes of each scene, which benchmarks carry as labels."""
from __future__ import annotations

from dataclasses import dataclass

from page.figure import Badge, Figure, Row, by_scene, label, measure, of_suite
from stored_run import Result, Run


@dataclass(frozen=True)
class Scene:
    """One scene at one commit, whose hashes must all be one."""

    name: str
    commit: str
    threads: tuple[int, ...]
    hashes: tuple[str, ...]  # each once

    @property
    def differs(self) -> bool:
        return len(self.hashes) > 1


def scenes(run: Run) -> list[Scene]:
    """All scenes with a hash. Those of another run have a row of their own: other code may have other bits."""
    found: dict[tuple[str, str], list[Result]] = {}
    for scene, results in by_scene(of_suite(run, "case")).items():
        for result in results.values():
            if result.labels:
                found.setdefault((scene, run.commit_of(result.name)), []).append(result)
    return [Scene(scene, commit, tuple(result.omp_threads or 1 for result in results),
                  tuple(dict.fromkeys(one for result in results for one in result.labels)))
            for (scene, commit), results in found.items()]


def differences(run: Run) -> list[str]:
    """A sentence for each scene whose bits hang on the number of threads, or on chance."""
    return [f"{scene.name} came to different bits: state hashes {', '.join(scene.hashes)} with {_threads(scene)}"
            for scene in scenes(run) if scene.differs]


def figure(run: Run) -> Figure:
    """Each scene with its threads and what they came to."""
    rows: list[Row] = [[label(scene.name), ", ".join(map(str, scene.threads)), ", ".join(scene.hashes),
                        _verdict(scene), scene.commit] for scene in scenes(run)]
    return Figure(
        "State hashes",
        "One scene must come to one hash, with any number of threads and in each repetition; phases and whole runs end "
        "in different states, so their hashes differ.",
        measure("^case/"), ["scene", "threads", "state hash", "verdict", "commit"], rows)


def _verdict(scene: Scene) -> Badge:
    if scene.differs:
        return Badge("DIFFERS", "poor")
    return Badge("same", "good") if len(scene.threads) > 1 else Badge("one number of threads only", "none")


def _threads(scene: Scene) -> str:
    return f"{', '.join(map(str, scene.threads))} thread{'s' * (scene.threads != (1,))}"
