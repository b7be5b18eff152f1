"""Names of benchmarks: what Google Benchmark appends is taken off, and the parts are told apart.

Appended words depend on how a run was made (/min_time:0.05, /repeats:5, /real_time); with them, the same benchmark of
two runs would count as two.
"""
from __future__ import annotations

import re
from dataclasses import dataclass

_APPENDED = re.compile(r"(min_time|min_warmup_time|iterations|repeats):.*|real_time|process_time|manual_time")


def normalise(name: str) -> str:
    """The benchmark's own name, the same in every run."""
    return "/".join(part for part in name.split("/") if not _APPENDED.fullmatch(part))


@dataclass(frozen=True)
class Name:
    """`case/capture/closing/threads:4` in parts: suite "case", parts ("capture", "closing"), threads 4."""

    suite: str
    parts: tuple[str, ...]
    threads: int | None

    @property
    def scene(self) -> str:
        """What was simulated, without the number of threads: results that differ in nothing else belong together."""
        return "/".join((self.suite, *self.parts))


def parse(name: str) -> Name:
    """Splits a normalised name. `long` only says that a quick run leaves the benchmark out, and is dropped."""
    threads = None
    parts = []
    for part in name.split("/"):
        if re.fullmatch(r"threads:\d+", part):
            threads = int(part.removeprefix("threads:"))
        elif part != "long":
            parts.append(part)
    return Name(parts[0] if parts else "", tuple(parts[1:]), threads)
