"""Reading Google Benchmark's JSON: names, repetitions, units, counters, and what a broken file is answered with."""
from __future__ import annotations

import json
import tempfile
import unittest
from pathlib import Path
from typing import Any

import sample
import names
import paper_times
from command_line import BadInput
from machine import isa
from stored_run import Result, read_run


class Names(unittest.TestCase):
    def test_what_google_benchmark_appends_is_taken_off(self) -> None:
        for name in ("case/capture/whole/threads:2/real_time",
                     "case/capture/whole/threads:2/min_time:0.050/real_time",
                     "case/capture/whole/threads:2/min_warmup_time:1.0/iterations:3/repeats:5/process_time/real_time"):
            self.assertEqual(names.normalise(name), "case/capture/whole/threads:2")

    def test_parts(self) -> None:
        name = names.parse("case/large_capture/closing/long/threads:16")
        self.assertEqual((name.suite, name.parts, name.threads), ("case", ("large_capture", "closing"), 16))
        self.assertEqual(name.scene, "case/large_capture/closing")
        self.assertIsNone(names.parse("element/bare/200").threads)


class Reading(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = Path(folder.name) / "run.json"

    def read(self, benchmarks: list[dict[str, Any]]) -> dict[str, Result]:
        self.file.write_text(json.dumps({"context": {}, "benchmarks": benchmarks}), encoding="utf-8")
        return read_run(self.file).results

    def assert_refused(self, text: str, message: str) -> None:
        self.file.write_text(text, encoding="utf-8")
        with self.assertRaises(BadInput) as caught:
            read_run(self.file)
        self.assertEqual(str(caught.exception), f"{self.file}{message}")

    def test_repetitions_are_gathered_and_aggregates_left_out(self) -> None:
        data = sample.google_json()
        self.file.write_text(json.dumps(data), encoding="utf-8")
        result = read_run(self.file).results["case/capture/whole/threads:4"]
        self.assertEqual(len(result.seconds), 5)
        self.assertEqual(result.omp_threads, 4)
        self.assertEqual(result.counters["elements"], 2300)
        self.assertNotIn("repetitions", result.counters)

    def test_units_and_medians_of_counters(self) -> None:
        results = self.read([{"name": "a", "real_time": 2, "time_unit": unit, "speed": speed}
                             for unit, speed in (("ns", 1.0), ("us", 7.0), ("ms", 3.0))])
        self.assertEqual(results["a"].seconds, (2e-9, 2e-6, 2e-3))
        self.assertEqual(results["a"].counters, {"speed": 3.0})

    def test_a_file_of_aggregates_gives_its_medians(self) -> None:
        rows = [{"name": f"a_{kind}", "run_name": "a", "run_type": "aggregate", "aggregate_name": kind,
                 "real_time": time, "time_unit": "s"} for kind, time in (("mean", 3), ("median", 2), ("stddev", 1))]
        self.assertEqual(self.read(rows)["a"].seconds, (2.0,))

    def test_the_clock_is_the_one_that_the_benchmark_goes_by(self) -> None:
        both = {"real_time": 3, "cpu_time": 2, "time_unit": "s"}
        results = self.read([{"name": "one_thread", **both}, {"name": "threads/real_time", **both},
                             {"name": "set/manual_time", **both}, {"name": "old", "real_time": 3, "time_unit": "s"}])
        self.assertEqual({name: (result.clock, *result.seconds) for name, result in results.items()},
                         {"one_thread": ("processor", 2), "threads": ("wall", 3), "set": ("wall", 3),
                          "old": ("wall", 3)})

    def test_each_label_is_kept_once(self) -> None:
        results = self.read([{"name": name, "real_time": 2, "time_unit": "s", "label": label}
                             for name, label in (("a", "0x1"), ("a", "0x2"), ("a", "0x1"), ("b", ""), ("c", 3))])
        self.assertEqual({name: result.labels for name, result in results.items()},
                         {"a": ("0x1", "0x2"), "b": (), "c": ()})

    def test_a_benchmark_that_gave_up_is_told_as_such(self) -> None:
        result = self.read([sample.gave_up("a", "no such case")])["a"]
        self.assertEqual((result.seconds, result.error), ((), "no such case"))

    def test_counters_that_are_no_number_are_left_out(self) -> None:
        self.file.write_text('{"context": {}, "benchmarks": [{"name": "a", "real_time": 1, "time_unit": "s", '
                             '"x": NaN, "y": Infinity, "z": 2}]}', encoding="utf-8")
        self.assertEqual(read_run(self.file).results["a"].counters, {"z": 2})

    def test_broken_json_is_told_with_line_and_column(self) -> None:
        self.assert_refused('{"context": {},\n "benchmarks": [,]}', ":2:17: not JSON: Expecting value")

    def test_json_that_is_something_else(self) -> None:
        what = ": not Google Benchmark's JSON: "
        self.assert_refused("[]", what + 'there is no list "benchmarks"')
        self.assert_refused('{"benchmarks": []}', what + 'there is no object "context"')
        self.assert_refused('{"context": {}, "benchmarks": [{}]}', what + 'benchmarks[0] has no text "name"')
        self.assert_refused('{"context": {}, "benchmarks": [{"name": "a", "time_unit": "s"}]}',
                            what + 'benchmarks[0] has no number "real_time"')
        self.assert_refused('{"context": {}, "benchmarks": [{"name": "a", "real_time": 1, "cpu_time": "1"}]}',
                            what + 'benchmarks[0] has no number "cpu_time"')
        self.assert_refused('{"context": {}, "benchmarks": [{"name": "a", "real_time": 1}]}',
                            what + 'benchmarks[0] has no "time_unit" of ns, us, ms, s')
        self.assert_refused('{"context": {}, "benchmarks": []}', ": holds no benchmark")

    def test_no_file_and_no_text(self) -> None:
        with self.assertRaisesRegex(BadInput, "none.json: No such file or directory$"):
            read_run(self.file.with_name("none.json"))
        self.file.write_bytes(b"\xff\xfe")
        with self.assertRaisesRegex(BadInput, "run.json: not text: byte 0 is no UTF-8$"):
            read_run(self.file)


class Machine(unittest.TestCase):
    def test_instruction_set_as_the_solver_chooses_it(self) -> None:
        v3 = {"avx2", "fma"}
        v4 = v3 | {"avx512f", "avx512vl", "avx512dq", "avx512bw"}
        self.assertEqual([isa(set(), True, None), isa(v3, True, None), isa(v4, True, None)], ["base", "v3", "v4"])
        self.assertEqual(isa(v4, False, None), "base")
        self.assertEqual(isa(v4, True, "v3"), "v3")


class PaperTimes(unittest.TestCase):
    def test_they_are_those_of_the_report(self) -> None:
        source = (sample.ROOT / "src/report/paper_numbers.cpp").read_text(encoding="utf-8")
        for elements, (minutes, seconds) in paper_times.RING_PULL.items():
            self.assertIn(f"if (elements == {elements}) return PaperCost{{{minutes}, {seconds}", source)
        for case, (minutes, seconds) in paper_times.WHOLE.items():
            self.assertIn(f'if (case_name == "{case}") return PaperCost{{{minutes}, {seconds}', source)

    def test_minutes_per_simulated_second(self) -> None:
        self.assertEqual(paper_times.minutes_per_simulated_second("ring_pull", 300), 15.4)
        self.assertEqual(paper_times.minutes_per_simulated_second("edge_closure", None), 110.2)
        self.assertIsNone(paper_times.minutes_per_simulated_second("ring_pull", 50))
        self.assertIsNone(paper_times.minutes_per_simulated_second("large_capture", 72000))


if __name__ == "__main__":
    unittest.main()
