"""The page as text: complete, self-contained, and honest about what was not measured."""
from __future__ import annotations

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample
import dashboard
import summary
from sample import run_of
from page import cases, parts, precision, scaling, stability
from machine import cpu
from stored_run import read_run

CHART_JS = "/* Chart.js is not looked at here */"


def page_of(data: dict[str, Any]) -> str:
    """The page of one run without a history."""
    return dashboard.render(run_of(data), [], CHART_JS, sample.found())


def embedded(page: str, element_id: str) -> Any:
    """JSON that the page carries."""
    found = re.search(rf'<script type="application/json" id="{element_id}">(.*?)</script>', page, re.DOTALL)
    assert found
    return json.loads(found[1])


class Page(unittest.TestCase):
    def test_it_loads_nothing_from_elsewhere(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            page = sample.store_page(Path(folder)).read_text(encoding="utf-8")
        self.assertNotRegex(page, r"(?i)(src|href|srcset|action)\s*=\s*[\"']?\s*(https?:|//)")
        self.assertNotRegex(page, r"(?i)url\(\s*[\"']?\s*(https?:|//)")
        self.assertNotRegex(page, r"(?i)@import|<link[^>]+stylesheet|<script[^>]+\ssrc|<iframe|<img")
        self.assertNotIn(str(sample.ROOT), page)

    def test_every_figure_has_title_axes_caption_and_numbers(self) -> None:
        page = page_of(sample.google_json())
        figures = re.findall(r'<figure class="plot">(.*?)</figure>', page, re.DOTALL)
        self.assertEqual(len(figures), 21)
        for figure in figures:
            for part in ("<h3>", "<canvas", "<figcaption>", "<details>", "<tbody><tr>"):
                self.assertIn(part, figure)
        for chart in embedded(page, "figures"):
            for axis in ("value",) if chart["type"] == "bar" else ("x", "y"):
                self.assertRegex(chart[axis]["title"], r"nodes|threads|speed-up|minutes|second|ns|ms|%|bytes|GB/s|"
                                                       r"cells|residual|Pa|step|m/s")

    def test_the_paper_stands_beside_the_cases(self) -> None:
        page = page_of(sample.google_json())
        chart = embedded(page, "figures")[0]
        paper = next(series for series in chart["series"] if "i7-6700HQ" in series["label"])
        self.assertEqual(dict(zip(chart["categories"], paper["values"])),
                         {"capture, whole": 58.25, "capture, deployment": None, "capture, closing": None,
                          "capture, closing without ledger": None, "capture, sliding until closed": None,
                          "edge_closure, whole": 110.2, "edge_closure, closing": None, "large_capture, closing": None,
                          "ring_pull, whole, 200 elements": 10.1, "ring_pull, sliding, 20 elements": None})
        self.assertIn("edge_closure, whole: 1,680 times faster", page)

    def test_no_number_of_threads_is_the_fastest_of_one(self) -> None:
        run = run_of(sample.google_json(only="case/capture/closing/threads:1"))  # and 16
        del run.results["case/capture/closing/threads:16"]
        (row,) = cases.run_time(run).rows
        self.assertEqual(row[2:4], (None, None))
        self.assertEqual(len(cases.run_time(run).chart["series"]), 1)
        self.assertEqual(summary.summary(run).splitlines()[1].split()[3:], ["-", "-", "-"])
        self.assertNotIn("fastest", summary.summary(run))

    def test_the_time_of_an_element_stands_beside_the_case(self) -> None:
        rows = {row[0]: row[-1] for row in cases.run_time(run_of(sample.google_json())).rows}
        self.assertAlmostEqual(float(str(rows["capture, closing"])), 10 / 3)

    def test_a_quick_page_says_what_it_leaves_out(self) -> None:
        for mode, told in (("quick", True), ("full", False)):
            page = page_of(sample.google_json(mode=mode))
            self.assertEqual("Quick runs leave out nets of 10^6 nodes" in page, told)

    def test_the_taut_net_is_explained_where_it_is_shown(self) -> None:
        data = sample.google_json(only="case/large_capture/")
        self.assertNotIn("taut by 0.1 %", cases.run_time(run_of(data)).caption)
        for entry in data["benchmarks"]:
            entry["run_name"] = entry["run_name"].replace("closing/long", "taut_net")
        self.assertIn("made soft and taut by 0.1 %", cases.run_time(run_of(data)).caption)

    def test_memory_of_small_nets_is_left_out(self) -> None:
        figure = scaling.memory(run_of(sample.google_json(only="growth/")))
        self.assertEqual({row[1] for row in figure.rows}, {99_856, 315_844, 1_000_000})

    def test_phases_are_not_compared_with_the_papers_whole_case(self) -> None:
        run = run_of(sample.google_json(only="case/capture/closing"))
        self.assertNotIn("times faster", dashboard.lead(run))
        self.assertEqual(summary.summary(run).splitlines()[1].split(),
                         ["capture,", "closing", "0.250", "0.0625", "16", "-"])

    def test_what_is_not_measured_names_its_command(self) -> None:
        page = page_of(sample.google_json(only="element/"))
        self.assertEqual(page.count("Not measured in this run."), 14)
        for suite in ("case", "growth", "reduction", "broadphase", "kernel"):
            self.assertIn(f"bench/run --benchmark_filter=&#x27;^{suite}/&#x27;", page)
        self.assertIn("No history yet.", page)

    def test_missing_counters_leave_gaps_not_errors(self) -> None:
        for keep in ("minutes_per_simulated_second", "element_updates_per_second", "nodes", "omp_threads"):
            data = sample.google_json()
            for entry in data["benchmarks"]:
                for key in [key for key in entry if "_" in key or key in ("nodes", "elements")]:
                    if key not in (keep, "run_name", "run_type", "aggregate_name", "aggregate_unit", "real_time",
                                   "time_unit"):
                        del entry[key]
            self.assertIn("<h1>", page_of(data))

    def test_the_study_names_the_fastest_setting_and_marks_the_papers(self) -> None:
        page = page_of(sample.google_json())
        chart = next(chart for chart in embedded(page, "figures") if chart["series"][0]["label"].startswith("the paper's own"))
        self.assertEqual([series["label"] for series in chart["series"]],
                         ["the paper's own choices", "contact, step 1e-06 s", "sliding, step 1e-06 s"])
        self.assertEqual(chart["series"][0]["values"], [[0.25, 4.0], [0.5, 2.0]])
        (figure,) = precision.figures(sample.of_study())
        assert figure.findings is not None
        self.assertEqual(figure.findings[1], [
            ["10 %", "sliding, step 1e-06 s, 6 elements", 0.003, "sliding, step 1e-06 s, 12 elements", 0.006],
            ["0.01 %", "none (the reference decides nothing so small)", None, "none", None]])
        self.assertIn("what the reference may be off by, 0.0400 %.", figure.caption)
        self.assertIn("<td>sliding, step 1e-06 s, 12 elements</td>", page)
        self.assertIn("at t = 1 s &lt;something&gt; went wrong", page)

    def test_the_study_s_other_measures_have_columns_and_older_files_have_none(self) -> None:
        study = sample.of_study()
        (problem,) = study["problems"]
        (figure,) = precision.figures(study)
        column = figure.headers.index("peak force (by chance), %")
        self.assertEqual([row[column] for row in figure.rows], [20.0] * 6 + [None, 5.0])
        self.assertEqual(figure.rows[-1][0], "the reference itself")
        self.assertEqual(figure.rows[3][figure.headers.index("order in the step")], 2.0)
        for key in ("measures", "step_orders"):
            del problem[key]
        for best in problem["best"]:
            best.pop("why", None)
        (older,) = precision.figures(study)
        self.assertNotIn("peak force (by chance), %", older.headers)
        assert older.findings is not None
        self.assertEqual(older.findings[1][1][1], "none")

    def test_chance_and_the_reference_s_own_error_count_against_a_setting(self) -> None:
        (problem,) = sample.of_study()["problems"]
        sliding = problem["runs"][3]  # is off by 0.833 %, the reference by 0.04 %
        self.assertEqual(precision.best_within(problem, 0.0088), sliding)
        self.assertEqual(precision.best_within(problem, 0.0085), problem["runs"][4])
        sliding["errors"]["uncertainty"] = 0.0002
        self.assertEqual(precision.best_within(problem, 0.0088), problem["runs"][4])
        self.assertIsNone(precision.best_within(problem, 0.0004))

    def test_study_and_matrix_name_their_own_commit_and_machine(self) -> None:
        study, matrix = precision.figures(sample.of_study()), stability.figures(sample.of_stability())
        for figure in study:
            self.assertIn("commit dddddddddddd on desk, Example CPU 2-Core, instruction set v4.", figure.caption)
        for figure in matrix:  # written before machines were
            self.assertIn("commit eeeeeeeeeeee on an unknown machine, instruction set v3.", figure.caption)

    def test_a_page_without_a_study_says_how_to_have_it(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            run = read_run(sample.store(Path(folder), "run", sample.google_json(only="element/")))
            self.assertIn("To measure it: <code>bench/study</code>", dashboard.render(run, [], CHART_JS))

    def test_the_matrix_is_counted_and_drawn_over_what_was_made_extreme(self) -> None:
        page = page_of(sample.google_json())
        charts = {chart["series"][0]["label"]: chart for chart in embedded(page, "figures")}
        self.assertEqual([series["values"] for series in charts["held"]["series"]], [[6, 4, 3], [0, 2, 0], [0, 0, 1]])
        over_modulus = charts["0.001 m"]
        self.assertEqual([series["label"] for series in over_modulus["series"]], ["0.001 m", "0.1 m"])
        self.assertEqual([x for x, _ in over_modulus["series"][0]["values"]], [1e5, 1e7, 1e9])
        impacts = charts["mass on a ball"]["series"][0]["values"]
        self.assertEqual(impacts[0], [0.1, None])  # nothing to draw for no residual
        self.assertIn("error: at &lt;t&gt;", page)

    def test_a_page_without_a_matrix_says_how_to_have_it(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            run = read_run(sample.store(Path(folder), "run", sample.google_json(only="element/")))
            self.assertIn("To measure it: <code>bench/stability</code>", dashboard.render(run, [], CHART_JS))

    def test_a_step_is_as_long_as_its_rate_says(self) -> None:
        figure = scaling.hand_over(run_of(sample.google_json()))
        steps = {row[0]: row[1] for row in figure.rows}
        self.assertEqual(steps["capture, closing"], 8000)  # 125,000 a second, whatever elements times their time give
        self.assertEqual(steps["net of 10,000 nodes"], 10_500 / 6e8 * 1e9)  # where no rate is counted

    def test_threads_are_compared_by_steps_where_one_side_counts_no_elements(self) -> None:
        data = sample.google_json(only="case/capture/closing")
        for entry in data["benchmarks"]:
            if "threads:2/" in entry["run_name"]:
                entry.pop("element_updates_per_second", None)
        rows = {row[1]: row[2] for row in scaling.speed_up(run_of(data)).rows}
        self.assertAlmostEqual(rows[2], sample.speed_up(2, 0.2))

    def test_whole_runs_and_free_flight_have_no_length_of_a_step(self) -> None:
        run = run_of(sample.google_json())
        beside = {row[0] for row in scaling.hand_over(run).rows}
        self.assertLessEqual({"capture, closing", "large_capture, closing"}, beside)
        self.assertFalse({"capture, whole", "ring_pull, whole", "edge_closure, whole", "capture, deployment"} & beside)
        for figure in (scaling.speed_up(run), scaling.efficiency(run)):
            without = {row[0] for row in figure.rows if row[figure.headers.index("step, ns")] is None}
            self.assertEqual(without, {"capture, whole", "ring_pull, whole", "edge_closure, whole",
                                       "capture, deployment"})

    def test_the_share_of_the_triad_is_told_as_what_it_is(self) -> None:
        run = run_of(sample.google_json(only="growth/"))
        caption = scaling.triad_share(run).caption
        for words in ("96 bytes a node", "24 bytes an item", "four steps share one sweep", "above 100 %"):
            self.assertIn(words, caption)
        piece = (sample.ROOT / "src/plan/piece.cpp").read_text(encoding="utf-8")
        for what in ("sweep_levels = 4;", "nodes_in_cache = 8000;"):  # what the caption says of the solver
            self.assertIn(what, piece)

    def test_captions_claim_no_more_than_was_measured(self) -> None:
        run = run_of(sample.google_json())
        self.assertIn("a whole run, with its output and, in the rest, its start-up", cases.stages(run).caption)
        self.assertNotIn("one step", cases.stages(run).caption)
        self.assertIn("Shares are those of the first thread. With AVX-512", cases.stages(run).caption)
        self.assertIn("no bound", parts.element(run).caption)

    def test_names_cannot_break_out_of_the_page(self) -> None:
        data = sample.google_json(machine="</script><b>", only="startup/")
        data["benchmarks"][0]["run_name"] = "startup/<i>&"
        page = page_of(data)
        self.assertNotIn("<b>", page)
        self.assertNotIn("<i>", page)

    def test_a_benchmark_that_gave_up_is_told(self) -> None:
        data = sample.google_json(only="element/")
        data["benchmarks"].append(sample.gave_up("case/x", "no case"))
        self.assertIn('<p class="alarm">case/x gave up: no case</p>', page_of(data))


class Programs(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.run_file = sample.store(self.folder, "run", sample.google_json())

    def refused(self, *arguments: object) -> str:
        done = subprocess.run([sys.executable, "-W", "error", sample.BENCH / "dashboard.py", *map(str, arguments)],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        return done.stderr

    def test_bad_instructions(self) -> None:
        file = self.folder / "instructions.json"
        file.write_text('{"rings": {"counted": 1}}', encoding="utf-8")
        self.assertEqual(self.refused(self.run_file, "--chart-js", self.run_file, "--instructions", file),
                         f'error: {file}: "rings" must hold the numbers "counted" and "stripped"\n')

    def test_bad_study(self) -> None:
        file = self.folder / "study.json"
        file.write_text('{"problems": [{}]}', encoding="utf-8")
        self.assertEqual(self.refused(self.run_file, "--chart-js", self.run_file, "--study", file),
                         f'error: {file}: must hold "problems" as bench/study writes them\n')

    def test_bad_matrix(self) -> None:
        file = self.folder / "stability.json"
        for text in ('[]', '{"groups": [], "cells": [{}]}'):
            file.write_text(text, encoding="utf-8")
            self.assertEqual(self.refused(self.run_file, "--chart-js", self.run_file, "--stability", file),
                             f'error: {file}: must hold "groups" and "cells" as bench/stability writes them\n')

    def test_a_study_is_signed_with_its_machine(self) -> None:
        file = self.folder / "study.json"
        file.write_text(json.dumps({"commit": "c", "isa": "v3", "problems": [{"error": 1e-17}]}), encoding="utf-8")
        subprocess.run([sys.executable, "-W", "error", sample.BENCH / "sign.py", file, "--machine", "desk"], check=True)
        self.assertEqual(json.loads(file.read_text(encoding="utf-8")),
                         {"machine": "desk", "cpu": cpu(), "commit": "c", "isa": "v3", "problems": [{"error": 1e-17}]})

    def test_no_chart_js_names_the_package(self) -> None:
        self.assertEqual(self.refused(self.run_file, "--chart-js", "/none"),
                         "error: /none: no such file; apt-get install libjs-chart.js\n")

    def test_summary(self) -> None:
        lines = summary.summary(read_run(self.run_file)).splitlines()
        self.assertRegex(lines[1], r"^capture, whole +0\.200 +0\.0688 +16 +58\.2 +847 times faster$")
        self.assertEqual(lines[-1], "the paper's: Core i7-6700HQ, 2.60 GHz")


if __name__ == "__main__":
    unittest.main()
