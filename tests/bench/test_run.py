"""bench/run and bench/count from end to end, with programs in the place of those that measure."""
from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample
import dashboard
from page import absent
from stored_run import read_run

# Lists names where asked to, else writes the run that lies beside it.
PROGRAM = """#!/usr/bin/env python3
import pathlib, sys
run = pathlib.Path(__file__).with_name("run.json").read_text()
names = pathlib.Path(__file__).with_name("names").read_text()
for argument in sys.argv:
    if argument == "--benchmark_list_tests=true":
        sys.exit(print(names))
    if argument.startswith("--benchmark_out="):
        pathlib.Path(argument.split("=", 1)[1]).write_text(run)
"""

# In place of src/build.sh, which installs and builds.
BUILD = """set -euo pipefail
cinch_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cinch_bench_packages=(python3)
cinch_install() { [ "$1" != valgrind ] || "$cinch_root/has_valgrind"; }
cinch_build() { :; }
"""

# Writes the study that lies beside it, and what it was asked for.
STUDY = """#!/usr/bin/env bash
cp "$(dirname "$0")/study.json" "$1/study.json"
echo "asked for: ${@:2}"
"""

COUNT = """#!/usr/bin/env bash
echo '{"rings": {"counted": 1010, "stripped": 1000}}' >"${@: -1}"
exit "$(cat "$(dirname "$0")/counts")"
"""


# In the place of cinch_count, which names its features and tells the hash that a run of steps ends with.
COUNTED = """#!/bin/sh
[ "$1" != --features ] || exec printf 'rings\\nballs\\n'
echo 0x1
"""

VALGRIND = """#!/usr/bin/env bash
for argument; do
  [[ $argument != --callgrind-out-file=* ]] || echo "totals: $((4096 * 1010))" >"${argument#*=}"
done
echo 0x1
"""


class Count(unittest.TestCase):
    def test_what_it_writes_says_where_it_was_counted_and_is_the_page_s(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in (("src/build.sh", BUILD), ("has_valgrind", "#!/bin/sh\n"), ("bin/valgrind", VALGRIND),
                               ("build/release/bench/cinch_count", COUNTED)):
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
                (root / name).chmod(0o755)
            shutil.copytree(sample.BENCH, root / "bench", ignore=shutil.ignore_patterns("__pycache__", "*.cpp"))
            subprocess.run([root / "bench/count", "--machine", "desk", root / "found.json"], check=True,
                           capture_output=True, env={**os.environ, "PATH": f"{root}/bin:{os.environ['PATH']}"})
            found = absent.read_instructions(root / "found.json") or {}
        self.assertEqual(found["features"], dict.fromkeys(("rings", "balls"), {"counted": 1010, "stripped": 1010}))
        self.assertEqual((found["machine"], found["commit"]), ("desk", "unknown"))
        self.assertIn(found["isa"], ("v3", "base"))
        self.assertRegex(found["date"], r"^\d{4}-\d\d-\d\d$")
        self.assertIn("cpu", found)


@unittest.skipUnless(dashboard.CHART_JS.exists(), "no Chart.js; to have it: apt-get install libjs-chart.js")
class FromEndToEnd(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        shutil.copytree(sample.BENCH, self.root / "bench", ignore=shutil.ignore_patterns("__pycache__", "*.cpp"))
        for name in ("src/report/page.css", "src/build.sh", "build/release/bench/cinch_bench", "has_valgrind"):
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(dashboard.REPORT_CSS, self.root / "src/report/page.css")
        (self.root / "src/build.sh").write_text(BUILD, encoding="utf-8")
        self.program(self.root / "build/release/bench/cinch_bench", PROGRAM)
        self.program(self.root / "bench/count", COUNT)
        self.valgrind("exit 0", counts=0)
        (self.root / "build/bench").mkdir()
        self.store = self.root / "store"

    def program(self, path: Path, text: str) -> None:
        path.write_text(text, encoding="utf-8")
        path.chmod(0o755)

    def valgrind(self, has: str, counts: int) -> None:
        self.program(self.root / "has_valgrind", f"#!/bin/sh\n{has}\n")
        (self.root / "bench/counts").write_text(str(counts), encoding="utf-8")

    def bench(self, data: dict[str, Any], *arguments: str) -> subprocess.CompletedProcess[str]:
        """bench/run, whose program measures `data`."""
        beside = self.root / "build/release/bench"
        (beside / "run.json").write_text(json.dumps(data), encoding="utf-8")
        if not arguments:  # a filtered run knows the others, too
            names = dict.fromkeys(entry["run_name"] for entry in data["benchmarks"] if "run_name" in entry)
            (beside / "names").write_text("\n".join(names), encoding="utf-8")
        environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
        return subprocess.run([self.root / "bench/run", "--store", self.store, *arguments], capture_output=True,
                              text=True, check=False, env=environment)

    def assert_page(self, words: str, there: bool = True) -> None:
        """In few words: the page is long."""
        page = (self.store / "dashboard.html").read_text(encoding="utf-8")
        self.assertEqual(words in page, there, words)

    def exported(self) -> set[str]:
        return set(json.loads((self.store / "bencher.json").read_text(encoding="utf-8")))

    def test_all_is_written(self) -> None:
        done = self.bench(sample.google_json(commit="aaaaaaaaaaaa"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assert_page("extra instructions, %")
        self.assertEqual(len(self.exported()), len(sample.run_of(sample.google_json()).results))

    def test_a_filtered_run_adds_to_the_page_but_is_exported_alone(self) -> None:
        self.bench(sample.google_json(commit="aaaaaaaaaaaa"))
        (run,) = (self.store / "runs").glob("*.json")
        run.rename(run.with_name("first.json"))  # both may begin within a second
        done = self.bench(sample.google_json(commit="bbbbbbbbbbbb", only="element/"), "--benchmark_filter=^element/")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assert_page("8 benchmarks of this run, ")
        self.assert_page("benchmarks from older runs: aaaaaaaaaaaa")
        self.assert_page("Not measured in this run. To measure it: <code>bench/run", False)
        self.assertEqual({name.split("/")[0] for name in self.exported()}, {"element"})

    def test_bits_that_differ_are_exit_code_5_with_page_and_exports(self) -> None:
        data = sample.google_json(only="case/capture/closing")
        data["benchmarks"][0]["label"] = "0x1"
        done = self.bench(data)
        self.assertEqual(done.returncode, 5)
        self.assertRegex(done.stderr, r"^error: case/capture/closing came to different bits: 0x1 with 1 thread; .*\n$")
        self.assert_page('class="alarm"')
        self.assertTrue(self.exported())

    def test_a_benchmark_that_gave_up_is_exit_code_1_with_page_and_exports(self) -> None:
        data = sample.google_json(only="element/")
        data["benchmarks"].append(sample.gave_up("case/x", "no case"))
        done = self.bench(data)
        self.assertEqual((done.returncode, done.stderr), (1, "error: case/x gave up: no case\n"))
        self.assert_page("case/x gave up: no case")
        self.assertTrue(self.exported())

    def test_without_valgrind_it_is_warned(self) -> None:
        self.valgrind("exit 1", counts=0)
        done = self.bench(sample.google_json(only="element/"))
        self.assertEqual((done.returncode, done.stderr),
                         (0, "warning: no valgrind: the page has no new instructions of absent features\n"))
        self.assertFalse((self.root / "build/bench/instructions.json").exists())

    def test_a_count_that_fails_leaves_the_page_and_exit_code_1(self) -> None:
        self.valgrind("exit 0", counts=1)
        self.assertEqual(self.bench(sample.google_json(only="element/")).returncode, 1)
        self.assert_page("<h1>")

    def study(self, *arguments: str) -> str:
        """What bench/study says."""
        beside = self.root / "build/release/bench"
        self.program(beside / "cinch_study", STUDY)
        (beside / "study.json").write_text(json.dumps(sample.of_study()), encoding="utf-8")
        done = subprocess.run([self.root / "bench/study", *arguments], capture_output=True, text=True, check=True,
                              env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"})
        return done.stdout

    def test_a_study_draws_the_page_of_the_stored_run_anew(self) -> None:
        self.store = self.root / "build/bench"
        self.bench(sample.google_json(commit="aaaaaaaaaaaa"))
        self.assert_page("A pull (Sec. 5.1)", False)
        said = self.study("--only", "pull", "--only", "other")
        self.assertIn("asked for: --only pull --only other\n", said)
        self.assertIn(f"dashboard: {self.store}/dashboard.html", said)
        self.assert_page("A pull (Sec. 5.1)")
        self.assert_page("aaaaaaaaaaaa")

    def test_a_study_without_a_stored_run_or_elsewhere_says_what_draws_it(self) -> None:
        words = f"bench/run draws {self.root}/build/bench/study.json on its page\n"
        self.assertTrue(self.study().endswith(words))
        self.store = self.root / "build/bench"
        self.bench(sample.google_json(commit="aaaaaaaaaaaa"))
        self.assertTrue(self.study(str(self.root / "elsewhere")).endswith(words))

    def test_runs_are_stored(self) -> None:
        self.bench(sample.google_json(only="element/"))
        (run,) = (self.store / "runs").glob("*.json")
        self.assertEqual(len(read_run(run).results), 8)


if __name__ == "__main__":
    unittest.main()
