"""The history: what is appended is read back, once for each run, and broken lines are told with their place."""
from __future__ import annotations

import json
import tempfile
import unittest
from pathlib import Path

import sample
import comparison
import dashboard
import history
from command_line import BadInput
from page import over_time
from page.figure import Badge
from stored_run import read_run


class History(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "deeper" / "history.jsonl"

    def test_round_trip(self) -> None:
        run = read_run(sample.store(self.folder, "2026-01-10T120000Z-aaaaaaaaaaaa", sample.google_json()))
        self.assertEqual(history.append(self.file, run), len(run.results))
        line = next(r for r in history.read(self.file) if r["benchmark"] == "case/capture/closing/threads:8")
        result = run.results["case/capture/closing/threads:8"]
        self.assertEqual(line["real_time_s"], {"median": sorted(result.seconds)[2], "min": min(result.seconds),
                                               "max": max(result.seconds), "n": 5})
        self.assertEqual(line["counters"], result.counters)
        about = {"schema": 1, "run": run.id, "date": "2026-01-10T11:00:00Z", "commit": "aaaaaaaaaaaa", "cores": 16,
                 "commit_date": "2026-01-10T11:00:00Z", "dirty": False, "machine_id": "lab, Example CPU 8-Core",
                 "isa": "v3", "compiler": "GNU 12.2.0", "build_type": "Release", "mode": "full", "omp_threads": 8,
                 "clock": "wall"}
        self.assertEqual({key: line[key] for key in about}, about)

    def test_a_run_is_added_once(self) -> None:
        run = read_run(sample.store(self.folder, "one", sample.google_json()))
        history.append(self.file, run)
        before = self.file.read_bytes()
        self.assertEqual(history.append(self.file, run), 0)
        self.assertEqual(self.file.read_bytes(), before)

    def test_a_run_without_our_context_is_taken(self) -> None:
        data = sample.google_json(only="element/")
        data["context"] = {"date": "2026-01-10T12:00:00+00:00", "host_name": "elsewhere", "num_cpus": 4}
        history.append(self.file, read_run(sample.store(self.folder, "bare", data)))
        line = history.read(self.file)[0]
        self.assertEqual((line["machine_id"], line["commit"], line["cores"]), ("elsewhere, unknown", "unknown", 4))
        self.assertEqual(line["commit_date"], line["date"])

    def test_there_is_no_history_yet(self) -> None:
        self.assertEqual(history.read(self.file), [])

    def assert_refused(self, text: str, message: str) -> None:
        self.file.parent.mkdir(exist_ok=True)
        self.file.write_text(text, encoding="utf-8")
        with self.assertRaises(BadInput) as caught:
            history.read(self.file)
        self.assertEqual(str(caught.exception), f"{self.file}{message}")

    def test_broken_lines(self) -> None:
        whole = {"schema": 1, "run": "r", "date": "", "commit": "", "commit_date": "", "machine_id": "m",
                 "benchmark": "b", "real_time_s": {"median": 1, "min": 1, "max": 1, "n": 1}}
        good = json.dumps(whole) + "\n"
        self.assert_refused(good + "\n" + good[:30], ":3:27: not JSON: Unterminated string starting at")
        self.assert_refused(good + "[]", ":2: no line of a history: it names no schema")
        self.assert_refused(good.replace('"schema": 1', '"schema": 2'), ":1: schema 2; this version of Cinch reads "
                            "schema 1")
        self.assert_refused(good.replace('"n"', '"k"'), ":1: real_time_s must hold median, min, max and n")
        self.assert_refused(good.replace('"run"', '"ran"'), ":1: lacks run")


LAB = "lab, Example CPU 8-Core; v3, GNU 12.2.0, Release, full"


def timed(seconds: float, repetitions: int = 1, **about: str) -> history.Record:
    """A line of the lab's history."""
    return {"schema": 1, "run": "r", "date": "2026-01-10T11:00:00Z", "commit": "aaaaaaaaaaaa",
            "commit_date": "2026-01-10T11:00:00Z", "machine_id": "lab, Example CPU 8-Core", "isa": "v3",
            "compiler": "GNU 12.2.0", "build_type": "Release", "mode": "full", "benchmark": "case/x",
            "real_time_s": {"median": seconds, "min": seconds, "max": seconds, "n": repetitions}, **about}


class OverTime(unittest.TestCase):
    def setUp(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "history.jsonl"
            for path in sample.store_history(Path(folder)):
                history.append(file, read_run(path))
            self.records = history.read(file)

    def test_machines_are_never_joined_and_commits_stand_in_order(self) -> None:
        points = over_time.points(self.records)
        self.assertEqual(set(points), {LAB, "cluster, Example CPU 64-Core; v3, GNU 12.2.0, Release, full"})
        for machine in points.values():
            row = machine["case/capture/whole/threads:1"]
            self.assertEqual([point.commit for point in row], list(sample.COMMITS))
            self.assertEqual([point.repetitions for point in row], [5, 5, 5])

    def test_what_a_run_was_made_with_is_kept_apart(self) -> None:
        others = [timed(4e-4, 1, **{key: value}) for key, value in (
            ("isa", "v4"), ("compiler", "Clang 19"), ("build_type", "Debug"), ("mode", "quick"), ("machine_id", "m"))]
        points = over_time.points([timed(1e-4, 5), *others])
        self.assertEqual([place["case/x"][0].spread.median for place in points.values()], [1e-4, *5 * [4e-4]])
        self.assertEqual(next(iter(points)), LAB)
        self.assertIn("lab, Example CPU 8-Core; v3, GNU 12.2.0, Release, quick", points)

    def test_figures_of_one_machine_stand_in_a_row(self) -> None:
        points = over_time.points([timed(1, machine_id="a"), timed(1, machine_id="b"),
                                   timed(1, machine_id="a", mode="quick")])
        self.assertEqual([place[0] for place in points], ["a", "a", "b"])

    def test_single_measurements_are_no_range_however_many_runs_there_are(self) -> None:
        later = {"commit": "bbbbbbbbbbbb", "commit_date": "2026-02-20T11:00:00Z"}
        quick = [timed(1.0), timed(1.01), timed(2.0, **later), timed(2.01, **later)]
        (place,) = over_time.points(quick).values()
        self.assertEqual([change.verdict for change in over_time.latest_changes(place)], ["slower"])
        self.assertIn(comparison.SINGLE, dashboard.changes_html(over_time.latest_changes(place)))
        self.assertEqual([point[1:5] for point in over_time.chart_data(place)["case/x"]],
                         [[1.005, None, None, 2], [2.005, None, None, 2]])
        for repetitions, seconds, verdict in ((5, 1.2, "slower"), (1, 1.2, "same"), (1, 1.3, "slower")):
            (place,) = over_time.points([timed(1.0, 5), timed(seconds, repetitions, **later)]).values()
            changes = over_time.latest_changes(place)
            self.assertEqual([change.verdict for change in changes], [verdict])
            self.assertEqual(comparison.SINGLE in dashboard.changes_html(changes), repetitions == 1)

    def test_runs_of_one_commit_are_one_point_but_uncommitted_changes_are_not(self) -> None:
        again = dict(self.records[0], run="again")
        changed = dict(self.records[0], run="changed", dirty=True, date="2026-06-01T00:00:00Z")
        points = over_time.points([self.records[0], again, changed])
        row = points[next(iter(points))][again["benchmark"]]
        self.assertEqual([(point.commit, point.repetitions) for point in row],
                         [(again["commit"], 10), (again["commit"] + " with changes", 5)])

    def test_older_times_on_the_wall_are_not_joined_with_those_of_the_processor(self) -> None:
        record = next(record for record in self.records if record["benchmark"] == "element/bare/200")
        old = dict(record, run="old")
        del old["clock"]
        (machine,) = over_time.points([old, record]).values()
        self.assertEqual({name: [point.repetitions for point in row] for name, row in machine.items()},
                         {"element/bare/200 (on the wall)": [5], "element/bare/200": [5]})

    def test_headlines_tell_of_each_place_what_the_latest_commit_changed(self) -> None:
        rows = over_time.headlines(over_time.points(self.records))
        self.assertEqual(len(rows), 2 * 6)
        (row,) = (row for row in rows if row[0] == "capture, whole" and row[-1] == LAB)
        self.assertEqual(row[1:4:2], ["bbbbbbbbbbbb", "cccccccccccc"])
        self.assertEqual(row[6].words if isinstance(row[6], Badge) else "", "faster")
        self.assertEqual(over_time.headlines(over_time.points(self.records[:1])), [])

    def test_latest_changes(self) -> None:
        machine = over_time.points(self.records)[LAB]
        changed = [(change.benchmark, change.verdict) for change in over_time.latest_changes(machine)
                   if change.verdict != "same"]
        self.assertEqual(changed, [("case/capture/whole/threads:1", "faster")])


if __name__ == "__main__":
    unittest.main()
