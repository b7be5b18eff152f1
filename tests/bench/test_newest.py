"""A run of a few benchmarks adds to the page: the others come from older runs of the same place, told as such."""
from __future__ import annotations

import contextlib
import io
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample
import newest
from page import bits, lead
from stored_run import Run, read_run

CHAIN, CLOSING = "element/chain/200", "case/capture/closing/threads:1"


class Newest(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_at(self, day: int, commit: str, **choice: Any) -> Run:
        """A run of March 2026, stored."""
        data = sample.google_json(commit=commit, **{"date": f"2026-03-{day:02}T12:00:00+00:00", **choice})
        return read_run(sample.store(self.folder, f"{day:02}-{commit}", data))

    def merged(self, run: Run, known: set[str] | None = None) -> Run:
        return newest.with_older(run, self.folder / "runs", known)

    def test_each_benchmark_is_of_the_newest_run_that_holds_it(self) -> None:
        self.run_at(1, "a", slower={CHAIN: 4, CLOSING: 4})
        self.run_at(2, "b", slower={CHAIN: 2, CLOSING: 2}, only="case/")
        run = self.merged(self.run_at(3, "c", only="element/"))
        self.assertEqual([run.commit_of(name) for name in (CHAIN, CLOSING, "output/frame")], ["c", "b", "a"])
        self.assertEqual(set(run.results), set(sample.run_of(sample.google_json()).results))
        self.assertAlmostEqual(run.results[CLOSING].median / 2, 0.25, delta=0.01)

    def test_runs_of_other_places_and_later_ones_are_left_alone(self) -> None:
        for key, value in (("machine", "cluster"), ("isa", "v4"), ("compiler", "Clang 19"), ("build_type", "Debug"),
                           ("mode", "quick"), ("date", "2026-03-04T00:00:00+00:00")):
            with self.subTest(key):
                self.run_at(1, "a", **{key: value})
                self.assertEqual(self.merged(self.run_at(3, "c", only="element/")).older, {})

    def test_benchmarks_that_the_program_no_longer_has_are_dropped(self) -> None:
        self.run_at(1, "a")
        run = self.merged(self.run_at(2, "b", only="element/"), {CLOSING})
        self.assertEqual(set(run.older), {CLOSING})

    def test_names_are_listed_as_google_benchmark_does(self) -> None:
        (self.folder / "known").write_text(f"{CLOSING}/iterations:200/real_time\n{CHAIN}\n\n", encoding="utf-8")
        self.assertEqual(newest.known_names(self.folder / "known"), {CLOSING, CHAIN})

    def test_a_broken_older_run_is_warned_of(self) -> None:
        self.run_at(1, "a")
        (self.folder / "runs/broken.json").write_text("{", encoding="utf-8")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            run = self.merged(self.run_at(2, "b", only="element/"))
        self.assertIn(CLOSING, run.older)
        self.assertRegex(said.getvalue(), r"^warning: .*broken\.json:1:2: not JSON: .*; left out of the page\n$")

    def test_the_page_tells_which_figures_are_older(self) -> None:
        alone = self.run_at(1, "a", dirty="yes")
        self.assertNotIn("older runs", lead.facts(self.merged(alone)))
        facts = lead.facts(self.merged(self.run_at(2, "b", only="element/")))
        older = len(alone.results) - 8
        self.assertIn(f"8 benchmarks of this run, {older} benchmarks from older runs: a with changes", facts)

    def test_bits_of_other_commits_may_differ(self) -> None:
        old = sample.google_json(commit="a", date="2026-03-01T12:00:00+00:00", only="case/capture/closing/")
        for entry in old["benchmarks"]:
            entry["label"] = "0x1"
        sample.store(self.folder, "old", old)
        run = self.merged(self.run_at(2, "b", only=CLOSING))
        self.assertEqual(bits.differences(run), [])
        self.assertEqual([(scene.commit, scene.threads) for scene in bits.scenes(run)],
                         [("b", (1, 16)), ("a", (2, 4, 8))])


if __name__ == "__main__":
    unittest.main()
