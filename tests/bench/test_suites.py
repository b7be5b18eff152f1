"""The benchmarks themselves: names and counters are the page's, stripped programs reach the solver's bits."""
from __future__ import annotations

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import sample  # finds bench's modules
import dashboard
import names
from stored_run import Result, Run, read_run

PROGRAM, COUNT = os.environ.get("CINCH_BENCH"), os.environ.get("CINCH_COUNT")


def output(*command: str | None) -> list[str]:
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


@unittest.skipUnless(PROGRAM and COUNT, "CINCH_BENCH and CINCH_COUNT name the programs")
class Suites(unittest.TestCase):
    def listed(self) -> list[names.Name]:
        return [names.parse(names.normalise(line)) for line in output(PROGRAM, "--benchmark_list_tests=true")]

    def measured(self, pattern: str) -> dict[str, Result]:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "run.json"
            output(PROGRAM, f"--benchmark_filter={pattern}", "--benchmark_min_time=0.001", f"--benchmark_out={file}",
                   "--benchmark_out_format=json")
            return read_run(file).results

    def test_every_suite_of_the_page_is_there(self) -> None:
        listed = self.listed()
        self.assertEqual({name.suite for name in listed},
                         {"machine", "element", "kernel", "reduction", "broadphase", "case", "growth", "absent", "startup",
                          "output"})
        self.assertEqual(len(listed), len(set(listed)), "a name stands for two benchmarks")
        for scene in {name.scene for name in listed if name.suite in ("case", "growth")}:
            self.assertIn(1, {name.threads for name in listed if name.scene == scene}, scene)

    def test_absent_features_have_both_sides(self) -> None:
        sides: dict[str, set[str]] = {}
        for name in self.listed():
            if name.suite == "absent":
                sides.setdefault(name.parts[0], set()).add(name.parts[1])
        self.assertLessEqual({"gravity", "damping", "rings", "target", "probes", "ledger"}, set(sides))
        self.assertEqual({feature: sorted(both) for feature, both in sides.items()},
                         dict.fromkeys(sides, ["with", "without"]))

    def test_counters(self) -> None:
        found = self.measured("^(element/chain/200$|absent/all/|growth/1024/threads:1/|kernel/ring_contact/16|"
                              "kernel/sliding_joint/16|output/frame|broadphase/620$|reduction/solver/1024/threads:1/|"
                              "case/ring_pull/sliding/)")
        expected = {
            "element/chain/200": {"element_updates_per_second", "fraction_of_yardstick"},
            "absent/all/with": {"element_updates_per_second"},
            "absent/all/without": {"element_updates_per_second"},
            "growth/1024/threads:1": {"nodes", "elements", "element_updates_per_second", "bytes_per_second",
                                      "fraction_of_triad", "omp_threads", "bytes_per_item"},
            "kernel/ring_contact/16": {"items_per_second"},
            "kernel/sliding_joint/16": {"items_per_second"},
            "output/frame": {"bytes_per_second"},
            "broadphase/620": {"pairs_tested", "pairs_kept", "elements", "items_per_second"},
            "reduction/solver/1024/threads:1": {"element_updates_per_second", "nodes", "omp_threads"},
            "case/ring_pull/sliding/threads:1": {"steps_per_second", "share_contacts", "handover_ns"},
        }
        self.assertEqual({name: result.error for name, result in found.items()}, dict.fromkeys(expected, ""))
        for name, counters in expected.items():
            self.assertLessEqual(counters, set(found[name].counters), name)
        self.assertRegex(found["case/ring_pull/sliding/threads:1"].labels[0], "^0x[0-9a-f]{16}$")
        self.assertGreater(found["kernel/ring_contact/16"].counters["loads"], 0)  # the rings do touch
        self.assertEqual(found["kernel/sliding_joint/16"].counters["loads"], 16)  # and all bend the thread

    def test_the_page_takes_what_is_measured(self) -> None:
        found = self.measured("^(element/chain/200$|growth/1024/threads:1/|broadphase/620$|case/ring_pull/sliding/)")
        run = Run(Path("run.json"), {"date": "2026-01-01T00:00:00Z"}, found)
        page = dashboard.render(run, [], "")
        for words in ("chain, 200 elements", "<td>620 elements", "ring_pull, sliding"):
            self.assertIn(words, page)

    def test_stripped_programs_reach_the_solvers_bits(self) -> None:
        for feature in output(COUNT, "--features"):
            with self.subTest(feature):
                self.assertEqual(*(output(COUNT, feature, side, "300") for side in ("stripped", "solver")))


if __name__ == "__main__":
    unittest.main()
