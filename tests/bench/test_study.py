"""The study of error against run time, in small: what it writes is the page's, and the best is the best."""
from __future__ import annotations

import csv
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample  # finds bench's modules
from page import precision

STUDY = os.environ.get("CINCH_STUDY")


@unittest.skipUnless(STUDY, "CINCH_STUDY names the program")
class Study(unittest.TestCase):
    problem: precision.Problem
    runs: list[dict[str, Any]]
    table: list[dict[str, str]]

    @classmethod
    def setUpClass(cls) -> None:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([str(STUDY), folder, "--trial"], capture_output=True, check=True)
            (cls.problem,) = precision.read_study(Path(folder) / "study.json")
            with (Path(folder) / "study.csv").open(encoding="utf-8") as file:
                cls.table = list(csv.DictReader(file))
        cls.runs = [run for run in cls.problem["runs"] if "errors" in run]

    def error(self, method: str, elements: int) -> float:
        return next(run["errors"]["error"] for run in self.runs
                    if (run["method"], run["elements"]) == (method, elements))

    def test_a_run_that_stops_is_told_with_the_reason(self) -> None:
        (stopped,) = (run for run in self.problem["runs"] if "errors" not in run)
        self.assertEqual((stopped["method"], stopped["elements"]), ("contact", 25))
        self.assertIn("an impact too hard for the time step", stopped["failure"])
        (row,) = (row for row in self.table if row["failure"])
        self.assertEqual((row["failure"], row["error"]), (stopped["failure"], "nan"))

    def test_few_sliding_elements_beat_many_with_contact(self) -> None:
        self.assertLess(self.error("sliding", 6), 0.01)
        self.assertGreater(self.error("contact", 50), 0.1)
        self.assertLess(self.error("contact", 100), self.error("contact", 50))

    def test_the_best_is_the_fastest_within_the_error(self) -> None:
        for best in self.problem["best"]:
            within = [run for run in self.runs if run["errors"]["error"] <= best["error"]]
            runs = self.problem["runs"]
            found = runs[best["run"]]["seconds_per_simulated_second"] if best["run"] is not None else None
            self.assertEqual(found, min((run["seconds_per_simulated_second"] for run in within), default=None))

    def test_the_table_says_the_same(self) -> None:
        rows = [row for row in self.table if not row["failure"]]
        self.assertEqual([(row["series"], int(row["elements"])) for row in rows],
                         [(run["series"], run["elements"]) for run in self.runs])
        for row, run in zip(rows, self.runs):
            self.assertTrue(math.isclose(float(row["error"]), run["errors"]["error"], rel_tol=1e-6))

    def test_the_page_draws_it(self) -> None:
        (figure,) = precision.figures([self.problem])
        self.assertEqual(len(figure.rows), len(self.problem["runs"]))
        self.assertEqual({series["label"] for series in figure.chart["series"]}, {run["series"] for run in self.runs})


if __name__ == "__main__":
    unittest.main()
