"""Decides whether a benchmark got slower: by its median and by the range of its repetitions. bench/compare and the
page's history both go by it."""
from __future__ import annotations

from dataclasses import dataclass

TOLERANCE = 0.05  # a median that moves by less is no news on any machine we know
SINGLE_TOLERANCE = 0.25  # the same for single measurements, whose ranges are unknown: they scatter by a fifth
SINGLE = (f"single measurements count as slower or faster from {100 * SINGLE_TOLERANCE:.0f} % on; less needs "
          "bench/run --full on both sides")


@dataclass(frozen=True)
class Spread:
    """Seconds per iteration over the repetitions of one benchmark."""

    median: float
    least: float
    greatest: float
    repeated: bool = True  # by a run itself: single measurements of several runs are no range


def judge(before: Spread, after: Spread, tolerance: float = TOLERANCE) -> str:
    """"slower", "faster" or "same". Ranges that overlap are noise, however far the medians lie apart."""
    if not (before.repeated and after.repeated):
        tolerance = max(tolerance, SINGLE_TOLERANCE)
    if after.least > before.greatest and after.median > before.median * (1 + tolerance):
        return "slower"
    if after.greatest < before.least and before.median > after.median * (1 + tolerance):
        return "faster"
    return "same"
