"""Exports have exactly the shapes that the dashboards document."""
from __future__ import annotations

import csv
import json
import statistics
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample
from stored_run import Result, read_run


class Exports(unittest.TestCase):
    folder: Path
    timed: dict[str, Result]  # the run's results that have times

    @classmethod
    def setUpClass(cls) -> None:
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        data = sample.google_json()
        data["benchmarks"].append(sample.gave_up("case/broken", ""))
        path = sample.store(cls.folder, "run", data)
        subprocess.run([sys.executable, sample.BENCH / "export.py", path, "--out", cls.folder], check=True,
                       capture_output=True)
        cls.timed = {name: result for name, result in read_run(path).results.items() if result.seconds}

    def read(self, name: str) -> Any:
        def refuse(constant: str) -> None:
            self.fail(f"{name} holds {constant}, which is not JSON")
        return json.loads((self.folder / name).read_text(encoding="utf-8"), parse_constant=refuse)

    def test_bencher_metric_format(self) -> None:
        data = self.read("bencher.json")
        self.assertEqual(set(data), set(self.timed))
        for name, measures in data.items():
            for measure in measures.values():
                self.assertLessEqual({"value"}, measure.keys())
                self.assertLessEqual(measure.keys(), {"value", "lower_value", "upper_value"})
                self.assertTrue(all(isinstance(value, (int, float)) for value in measure.values()))
            time = measures["latency"]
            self.assertLessEqual(time["lower_value"], time["value"])
            self.assertLessEqual(time["value"], time["upper_value"])
            self.assertAlmostEqual(time["value"], 1e9 * statistics.median(self.timed[name].seconds))
            self.assertEqual(set(measures) - {"latency"}, set(self.timed[name].counters))

    def test_github_action_benchmark(self) -> None:
        data = self.read("github-action-benchmark.json")
        self.assertEqual([entry["name"] for entry in data], list(self.timed))
        for entry in data:
            self.assertEqual({key: type(value) for key, value in entry.items()},
                             {"name": str, "unit": str, "value": float, "range": str, "extra": str})
            self.assertAlmostEqual(entry["value"], 1e9 * self.timed[entry["name"]].median)

    def test_csv(self) -> None:
        with (self.folder / "results.csv").open(encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["benchmark"] for row in rows], list(self.timed))
        self.assertEqual(list(rows[0])[:12], ["date", "commit", "machine_id", "isa", "compiler", "mode", "benchmark",
                                              "clock", "median_s", "min_s", "max_s", "n"])
        self.assertEqual({(row["compiler"], row["mode"]) for row in rows}, {("GNU 12.2.0", "full")})
        self.assertEqual({row["clock"] for row in rows if row["benchmark"].startswith("kernel/")}, {"processor"})
        self.assertEqual({row["clock"] for row in rows if row["benchmark"].startswith("case/")}, {"wall"})
        for row in rows:
            result = self.timed[row["benchmark"]]
            self.assertEqual(float(row["median_s"]), result.median)
            self.assertEqual({key: float(value) for key, value in list(row.items())[12:] if value}, result.counters)


if __name__ == "__main__":
    unittest.main()
