"""bench/compare as a program: planted changes, noise, warnings, exit codes; and refusals of bench/run and others."""
from __future__ import annotations

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample
from comparison import Spread, judge

SLOW = "case/capture/whole/threads:1"
FAST = "element/chain/200"


class Judging(unittest.TestCase):
    def test_ranges_and_tolerance_decide_together(self) -> None:
        before = Spread(1.0, 0.9, 1.1)
        self.assertEqual(judge(before, Spread(1.3, 1.11, 1.4)), "slower")
        self.assertEqual(judge(before, Spread(1.3, 1.10, 1.4)), "same")  # the ranges touch
        self.assertEqual(judge(before, Spread(0.7, 0.6, 0.89)), "faster")
        self.assertEqual(judge(Spread(1, 1, 1), Spread(1.04, 1.04, 1.04)), "same")
        self.assertEqual(judge(Spread(1, 1, 1), Spread(1.04, 1.04, 1.04), 0.03), "slower")

    def test_single_measurements_have_a_tolerance_of_their_own(self) -> None:
        once, more, most = (Spread(time, time, time, False) for time in (1.0, 1.24, 1.26))
        self.assertEqual([judge(once, more), judge(once, more, 0.01), judge(once, most)], ["same", "same", "slower"])
        self.assertEqual([judge(more, once), judge(most, once)], ["same", "faster"])
        self.assertEqual(judge(once, Spread(1.2, 1.19, 1.21)), "same")  # one side is not enough
        self.assertEqual(judge(once, most, 0.3), "same")


class Compare(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.before = self.store("a", sample.google_json())

    def store(self, name: str, data: dict[str, Any]) -> Path:
        return sample.store(self.folder, name, data)

    def compare(self, *arguments: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run([sys.executable, "-W", "error", sample.BENCH / "compare", *map(str, arguments)],
                              capture_output=True, text=True, check=False)

    def test_a_planted_slow_down_is_found(self) -> None:
        after = self.store("b", sample.google_json(commit="bbbbbbbbbbbb", slower={SLOW: 1.2, FAST: 0.8}, seed=2))
        done = self.compare(self.before, after)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertEqual(done.stderr, "")
        lines = done.stdout.splitlines()
        self.assertRegex(lines[1], rf"^{SLOW} .* \+(19|20|21)\.\d % +slower$")
        self.assertRegex(lines[2], rf"^{FAST} .* -(19|20|21)\.\d % +faster$")
        self.assertRegex(lines[-1], r"^1 slower, 1 faster, \d+ same, 0 new, 0 missing$")

    def test_noise_is_no_slow_down(self) -> None:
        done = self.compare(self.before, self.store("b", sample.google_json(seed=2)))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"^0 slower, 0 faster, ")

    def test_getting_faster_is_no_failure(self) -> None:
        done = self.compare(self.before, self.store("b", sample.google_json(slower={FAST: 0.5})))
        self.assertEqual(done.returncode, 0)

    def test_tolerance(self) -> None:
        after = self.store("b", sample.google_json(slower={SLOW: 1.2}))
        self.assertEqual(self.compare("--tolerance", "25", self.before, after).returncode, 0)
        self.assertEqual(self.compare("--tolerance", "15%", self.before, after).returncode, 5)

    def test_new_and_missing(self) -> None:
        cases, elements = (self.store(only, sample.google_json(only=only)) for only in ("case", "element"))
        done = self.compare(cases, elements)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, rf"(?m)^{SLOW} .*missing$")
        self.assertRegex(done.stdout, rf"(?m)^{FAST} .*new$")

    def test_all_lists_what_stayed_the_same(self) -> None:
        self.assertRegex(self.compare("--all", self.before, self.before).stdout, rf"(?m)^{FAST} .* \+0\.0 % +same$")

    def test_warnings(self) -> None:
        data = sample.google_json("cluster", isa="v4", compiler="Clang 19", build_type="Debug", mode="quick")
        for entry in data["benchmarks"]:
            if entry["name"].startswith("machine/handover"):
                entry["handover_ns"] = 400.0
        done = self.compare(self.before, self.store("b", data))
        for what in ("machine differs (lab, Example CPU 8-Core; cluster, Example CPU 64-Core)",
                     "isa differs (v3; v4)", "compiler differs", "build_type differs", "mode differs (full; quick)",
                     "hand-over between threads differs (180 ns; 400 ns)"):
            self.assertIn(f"warning: {what}", done.stderr)

    def test_single_measurements_are_warned_of(self) -> None:
        once = self.store("b", sample.google_json(repetitions=1, slower={SLOW: 1.2, FAST: 1.3}))
        done = self.compare(self.before, once)
        self.assertEqual(done.stderr, "warning: B has no ranges: single measurements count as slower or faster from 25 % "
                                      "on; less needs bench/run --full on both sides\n")
        self.assertEqual(done.returncode, 5)
        self.assertRegex(done.stdout, rf"(?m)^{FAST} .* slower$")
        self.assertNotIn(SLOW, done.stdout)

    def test_what_gave_up_is_a_failure(self) -> None:
        data = sample.google_json()
        data["benchmarks"] = [entry for entry in data["benchmarks"] if entry["run_name"] != FAST]
        broken = self.store("b", {**data, "benchmarks": [*data["benchmarks"], sample.gave_up(FAST, "why")]})
        done = self.compare(self.before, broken)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertRegex(done.stdout, rf"(?m)^{FAST} .* gave up$")
        self.assertRegex(done.stdout, r", 0 missing, 1 gave up\n$")
        self.assertEqual(self.compare(broken, self.before).returncode, 0)

    def test_bad_input_is_one_line_and_exit_code_2(self) -> None:
        broken = self.folder / "broken.json"
        broken.write_text('{"context": {},\n"benchmarks": [', encoding="utf-8")
        for arguments, message in (
                ((self.before, broken), f"error: {broken}:2:16: not JSON: Expecting value\n"),
                ((self.before, self.folder / "none"), f"error: {self.folder}/none: No such file or directory\n"),
                ((self.folder, self.before), f"error: {self.folder}: Is a directory\n"),
                ((self.before,), "error: the following arguments are required: B; see bench/compare --help\n"),
                (("--tolerance", "-1", self.before, self.before), "error: argument --tolerance: -1: allowed is a "
                 "number of per cent, 0 or more; see bench/compare --help\n")):
            done = self.compare(*arguments)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", message))


class RunRefuses(unittest.TestCase):
    def test_bad_arguments_before_anything_is_built(self) -> None:
        for arguments, message in ((["--fast"], "error: unknown argument '--fast'; allowed: "),
                                   (["--store"], "error: --store needs a value"),
                                   (["--benchmark_out=x"], "error: --benchmark_out is set by bench/run itself")):
            done = subprocess.run([sample.BENCH / "run", *arguments], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertTrue(done.stderr.startswith(message), done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)

    def test_other_programs_want_a_machine_s_name(self) -> None:
        for program in ("study", "stability", "count"):
            done = subprocess.run([sample.BENCH / program, "--machine"], capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", "error: --machine needs a name\n"))


if __name__ == "__main__":
    unittest.main()
