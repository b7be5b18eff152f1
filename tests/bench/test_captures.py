"""What many captures have in common: medians and ranges, and events that not every run has."""
from __future__ import annotations

import unittest
from typing import Any

import sample  # noqa: F401  finds bench's modules
import captures


def summary(residual: float, closed: float | None) -> dict[str, Any]:
    events = [] if closed is None else [{"kind": "mouth_closed", "time": closed}]
    return {"energy": {"residual": residual, "relative_residual": abs(residual) / 2}, "events": events,
            "wall_seconds": 0.5}


class Captures(unittest.TestCase):
    def test_medians_and_ranges(self) -> None:
        found = captures.rows([summary(-4e-3, 1.8), summary(1e-3, None), summary(2e-3, 1.9)])
        self.assertEqual(found, [["energy residual, J", "0.00200", "0.00100", "0.00400", "3"],
                                 ["energy residual, relative", "0.00100", "0.000500", "0.00200", "3"],
                                 ["mouth closed, s", "1.85", "1.80", "1.90", "2"],
                                 ["run time, s", "0.500", "0.500", "0.500", "3"]])


if __name__ == "__main__":
    unittest.main()
