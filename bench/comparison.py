"""Decides whether a benchmark got slower: by its median and by the range of its repetitions."""
from __future__ import annotations

from dataclasses import dataclass

TOLERANCE = 0.05  # a median that moves by less is no news on any machine we know


@dataclass(frozen=True)
class Spread:
    """Seconds per iteration over the repetitions of one benchmark."""

    median: float
    least: float
    greatest: float


def judge(before: Spread, after: Spread, tolerance: float = TOLERANCE) -> str:
    """"slower", "faster" or "same". Ranges that overlap are noise, however far the medians lie apart."""
    if after.least > before.greatest and after.median > before.median * (1 + tolerance):
        return "slower"
    if after.greatest < before.least and before.median > after.median * (1 + tolerance):
        return "faster"
    return "same"
