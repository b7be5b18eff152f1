"""Each benchmark from the newest stored run that holds it: a run of a few benchmarks then adds to a page and empties
none of its figures. Only runs made in the same place, with the same machine, compiler and mode, are put together."""
from __future__ import annotations

import dataclasses
import sys
from pathlib import Path

import names
from command_line import BadInput
from stored_run import MADE_WITH, Run, read_run, read_text


def place(run: Run) -> tuple[str, ...]:
    """Times of different places are not put together."""
    return (run.machine_id, *(run.about(key) for key in MADE_WITH))


def with_older(run: Run, folder: Path, known: set[str] | None = None) -> Run:
    """The run, and what it lacks from the newest of the older runs in `folder`. Of those only `known` benchmarks are
    taken, where given: names that the program no longer has would stay on the page for ever."""
    older: dict[str, Run] = {}
    for other in sorted(_others(run, folder), key=lambda other: other.date, reverse=True):
        for name in other.results:
            if name not in run.results and name not in older and (known is None or name in known):
                older[name] = other
    results = {**run.results, **{name: other.results[name] for name, other in older.items()}}
    return dataclasses.replace(run, results=results, older=older)


def _others(run: Run, folder: Path) -> list[Run]:
    """Older runs of the same place. One that cannot be read is left out with a warning: it is not this run's fault."""
    found = []
    for path in sorted(folder.glob("*.json")):
        try:
            other = read_run(path) if path.resolve() != run.path.resolve() else None
        except BadInput as error:
            print(f"warning: {error}; left out of the page", file=sys.stderr)
            continue
        if other and place(other) == place(run) and other.date <= run.date:
            found.append(other)
    return found


def known_names(file: Path) -> set[str]:
    """Names as Google Benchmark lists them, one a line."""
    return {names.normalise(line) for line in read_text(file).splitlines() if line}
