"""Run times that the paper gives (Si, Pang, Du and Fu 2021). src/report/paper_numbers.cpp holds the same, and a test
compares the two."""
from __future__ import annotations

MACHINE = "Core i7-6700HQ, 2.60 GHz"  # Sec. 5.3

# Minutes of the paper's run and what it simulated, in seconds, by case; ring_pull by its number of elements.
RING_PULL = {100: (5.2, 1.0), 200: (10.1, 1.0), 300: (15.4, 1.0)}  # Sec. 5.1
WHOLE = {"edge_closure": (55.1, 0.5), "capture": (116.5, 2.0)}  # Secs. 5.2, 5.3


def minutes_per_simulated_second(case: str, elements: float | None) -> float | None:
    """The paper's figure for the whole run of a case; None where it gives none."""
    of_size = RING_PULL.get(int(elements)) if case.startswith("ring_pull") and elements else None
    found = of_size or WHOLE.get(case)
    return found[0] / found[1] if found else None
