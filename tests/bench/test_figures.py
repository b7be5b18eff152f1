"""Figures beside the cases': other programs, ways to sum forces, searches, absent features."""
from __future__ import annotations

import json
import re
import tempfile
import unittest
from pathlib import Path

import sample
import other_programs
from page import absent, broadphase, others, parts, reduction
from page.html import figure_html


class Others(unittest.TestCase):
    def test_scenes_are_compared_at_the_others_step(self) -> None:
        figure = others.figure(sample.run_of(sample.google_json()))
        rows = {str(row[0]): row[1:] for row in figure.rows}
        self.assertEqual(len(rows), 15)
        theirs, own, faster = rows["net of 781 nodes: MoorDyn"]
        assert isinstance(own, float) and isinstance(faster, float)
        self.assertEqual(theirs, 2.6)
        self.assertAlmostEqual(own, 880 / 3e8 * 1e6 / 60)
        self.assertAlmostEqual(faster, 2.6 / own)
        chain = rows["chain of 200 elements: LAMMPS"][1]
        assert isinstance(chain, float)
        self.assertAlmostEqual(chain, 200 / 7e8 * 1e6 / 60)
        self.assertIn("Cinch is 1.87 (net of 1,737 nodes: LAMMPS) to 153 (chain of 200 elements: Project Chrono) times "
                      "as fast.", figure.caption)

    def test_scenes_that_are_not_measured_are_named_not_drawn(self) -> None:
        figure = others.figure(sample.run_of(sample.google_json(only="element/")))
        self.assertFalse([row for row in figure.rows if "10^" in str(row[0])])
        self.assertIn("Not measured in this run: net of 10^5 nodes; net of 10^6 nodes; net of 10^6 nodes, 2 threads. "
                      "To measure them: bench/run --benchmark_filter=", figure.caption)
        self.assertIn("Not measured in this run. To measure it", figure_html(
            others.figure(sample.run_of(sample.google_json(only="output/"))), 0))

    def test_numbers_are_those_of_the_readme(self) -> None:
        readme = (sample.BENCH / "README.md").read_text(encoding="utf-8")
        table = readme[readme.index("## Others"):readme.index("## Stability")]
        for scene in other_programs.SCENES:
            for program, minutes in scene.minutes.items():
                milliseconds = minutes * 60 * other_programs.STEP_S * 1e3
                words = f"{milliseconds:.3g}" if scene.benchmark.startswith("growth/") else f"{minutes:.2g}"
                self.assertRegex(table, rf"\b{re.escape(words)}", (scene.words, program))


class Ways(unittest.TestCase):
    def test_reductions_stand_side_by_side(self) -> None:
        figure = reduction.figure(sample.run_of(sample.google_json(only="reduction/")))
        self.assertEqual(figure.headers, ["net", "Cinch, ns", "gather, ns", "coloured scatter, ns",
                                          "private sums, ns"])
        self.assertEqual([str(row[0]) for row in figure.rows[4:6]],
                         ["1,024 nodes, 16 threads", "99,856 nodes, 1 thread"])
        self.assertEqual([round(float(str(cell)), 3) for cell in figure.rows[5][1:]], [1.25, 2.5, 4.167, 3.125])

    def test_searches_tell_pairs_tested_and_kept(self) -> None:
        figure = broadphase.figure(sample.run_of(sample.google_json(only="broadphase/")))
        self.assertEqual(list(figure.rows[0]), ["1,000 elements", 100.0, 40_000, 3_000, 40.0, 7.5])

    def test_small_nets_stand_beside_the_chains(self) -> None:
        rows = {str(row[0]): row for row in parts.element(sample.run_of(sample.google_json(only="element/"))).rows}
        self.assertEqual(list(rows), ["chain, 200 elements", "chain, 2000 elements", "net of 781 nodes",
                                      "net of 1737 nodes"])
        self.assertEqual(rows["net of 781 nodes"][1:3], (None, None))
        self.assertAlmostEqual(float(str(rows["net of 781 nodes"][3])), 10 / 3)


class Absent(unittest.TestCase):
    def labels(self, repetitions: int, counted: bool = True) -> list[str]:
        run = sample.run_of(sample.google_json(only="absent/", repetitions=repetitions))
        chart = absent.figure(run, sample.INSTRUCTIONS if counted else None).chart
        return [series["label"] for series in chart.get("series", [])]

    def test_times_that_were_not_repeated_stand_in_the_table_alone(self) -> None:
        self.assertEqual(self.labels(5), ["instructions", "time"])
        self.assertEqual(self.labels(1), ["instructions"])
        run = sample.run_of(sample.google_json(only="absent/", repetitions=1))
        self.assertEqual(absent.figure(run, sample.INSTRUCTIONS).chart["categories"], ["rings", "balls"])
        figure = absent.figure(run, None)
        self.assertEqual(figure.headers, ["feature", "extra instructions, %", "extra time, %"])
        self.assertTrue(all(isinstance(row[2], float) for row in figure.rows))
        page = figure_html(figure, 0)
        self.assertIn("<td>rings</td>", page)
        self.assertNotIn("<canvas", page)

    def test_it_is_told_where_instructions_were_counted(self) -> None:
        run = sample.run_of(sample.google_json(only="absent/"))
        self.assertIn("counted at commit ffffffffffff on desk, Example CPU 2-Core, instruction set v3, on 2026-04-02.",
                      absent.figure(run, sample.INSTRUCTIONS).caption)
        self.assertIn("bench/count", absent.figure(run, None).caption)
        self.assertIn("noise of some ten per cent", absent.figure(run, None).caption)

    def test_files_of_features_alone_are_read_as_well(self) -> None:
        features = sample.INSTRUCTIONS["features"]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "instructions.json"
            for data, expected in ((features, {"features": features}), (sample.INSTRUCTIONS, sample.INSTRUCTIONS)):
                file.write_text(json.dumps(data), encoding="utf-8")
                self.assertEqual(absent.read_instructions(file), expected)
            self.assertIsNone(absent.read_instructions(Path(folder) / "none"))


if __name__ == "__main__":
    unittest.main()
