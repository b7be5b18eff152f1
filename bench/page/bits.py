"""Whether the number of threads changes bits: state hashes of each scene, which benchmarks carry as labels."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable

from page.figure import Badge, Figure, Row, by_scene, label, measure, of_suite
from stored_run import Run


@dataclass(frozen=True)
class Scene:
    """One scene at one commit, whose hashes must all be one."""

    name: str
    commit: str
    hashes: dict[str, list[int]]  # each with the numbers of threads that came to it

    @property
    def threads(self) -> tuple[int, ...]:
        return tuple(sorted({threads for of_hash in self.hashes.values() for threads in of_hash}))

    @property
    def differs(self) -> bool:
        return len(self.hashes) > 1


def scenes(run: Run) -> list[Scene]:
    """All scenes with a hash. Those of another run have a row of their own: other code may have other bits."""
    found: dict[tuple[str, str], dict[str, list[int]]] = {}
    for scene, results in by_scene(of_suite(run, "case")).items():
        for threads, result in results.items():
            for state_hash in result.labels:
                at_commit = found.setdefault((scene, run.commit_of(result.name)), {})
                at_commit.setdefault(state_hash, []).append(threads)
    return [Scene(scene, commit, hashes) for (scene, commit), hashes in
            sorted(found.items(), key=lambda item: item[0][0])]


def differences(run: Run) -> list[str]:
    """A sentence for each scene whose bits hang on the number of threads, or on chance."""
    return [f"{scene.name} came to different bits: " + "; ".join(
                f"{state_hash} with {_words(threads)} thread{'s' * (threads != [1])}"
                for state_hash, threads in scene.hashes.items())
            for scene in scenes(run) if scene.differs]


def figure(run: Run) -> Figure:
    """Each scene with its threads and what they came to."""
    rows: list[Row] = [[label(scene.name), _words(scene.threads), ", ".join(scene.hashes), _verdict(scene),
                        scene.commit] for scene in scenes(run)]
    return Figure(
        "State hashes",
        "One scene must come to one hash, with any number of threads and in each repetition; phases and whole runs end "
        "in different states, so their hashes differ.",
        measure("^case/"), ["scene", "threads", "state hash", "verdict", "commit"], rows)


def _verdict(scene: Scene) -> Badge:
    if scene.differs:
        return Badge("DIFFERS", "poor")
    return Badge("same", "good") if len(scene.threads) > 1 else Badge("one number of threads only", "none")


def _words(threads: Iterable[int]) -> str:
    return ", ".join(map(str, threads))
