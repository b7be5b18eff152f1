"""Targets and state hashes: met, missed and not measured are told apart, and a difference in bits is an alarm."""
from __future__ import annotations

import unittest
from typing import Any

import sample
from page import bits, lead, targets
from page.figure import Badge, Row

CLOSING = "case/capture/closing"


def changed(counters: dict[str, dict[str, Any]], **choice: Any) -> dict[str, Any]:
    """A run with some counters of some benchmarks changed."""
    data = sample.google_json(**choice)
    for entry in data["benchmarks"]:
        entry.update(counters.get(entry["run_name"].removesuffix("/real_time"), {}))
    return data


def row(part: str, data: dict[str, Any], instructions: dict[str, Any] | None = None) -> Row:
    """Measured, verdict and command of one target."""
    figure = targets.figure(sample.run_of(data), instructions)
    (found,) = (row for row in figure.rows if row[0] == part)
    return [found[2], found[3].words if isinstance(found[3], Badge) else "", found[4]]


class Targets(unittest.TestCase):
    def test_every_target_can_be_measured(self) -> None:
        figure = targets.figure(sample.run_of(sample.google_json()), sample.INSTRUCTIONS)
        self.assertEqual([row[0] for row in figure.rows if row[2] == "–"], [])
        self.assertEqual(len(figure.rows), 22)

    def test_a_run_of_something_else_measures_none_and_names_what_would(self) -> None:
        figure = targets.figure(sample.run_of(sample.google_json(only="output/")), None)
        self.assertEqual(figure.title, "0 met, 0 missed, 22 not measured")
        self.assertTrue(all("bench/" in str(row[4]) for row in figure.rows))

    def test_numbers_on_either_side_of_the_target(self) -> None:
        one, two = f"{CLOSING}/threads:1", f"{CLOSING}/threads:2"
        for part, name, good, bad, words in (
                ("Element update, chain of 200", "element/chain/200", {"fraction_of_yardstick": 0.91},
                 {"fraction_of_yardstick": 0.9}, "1.10 times"),
                ("Contacts, capture closing", one, {"share_contacts": 0.35, "steps_per_second": 1e6},
                 {"share_contacts": 0.36, "steps_per_second": 1e6}, "0.350 µs"),
                ("Search for pairs, capture closing", one, {"share_broadphase": 0.03}, {"share_broadphase": 0.031},
                 "3.00 %"),
                ("Energy ledger, capture closing", "case/capture/closing_without_ledger/threads:1",
                 {"steps_per_second": 1.25e5 * 1.049}, {"steps_per_second": 1.25e5 * 1.051}, "4.90 %"),
                ("Probes and peaks, capture whole", "case/capture/whole/threads:1", {"share_observe": 0.05},
                 {"share_observe": 0.051}, "5.00 %"),
                ("ring_pull whole, 1 thread", "case/ring_pull/whole/threads:1",
                 {"minutes_per_simulated_second": 0.35 / 60}, {"minutes_per_simulated_second": 0.36 / 60}, "0.350 s/s"),
                ("Capture closing, 1 thread", one, {"minutes_per_simulated_second": 1.7 / 60},
                 {"minutes_per_simulated_second": 1.71 / 60}, "1.70 s/s"),
                ("Capture whole, 1 thread", "case/capture/whole/threads:1", {"minutes_per_simulated_second": 0.99 / 60},
                 {"minutes_per_simulated_second": 1.01 / 60}, "1.98 s"),
                ("Capture closing, 2 threads", two, {"handover_ns": 50, "minutes_per_simulated_second": 1 / 60},
                 {"handover_ns": 50, "minutes_per_simulated_second": 1.1 / 60}, "1.00 s/s, hand-over 50.0 ns"),
                ("large_capture closing, 1 thread", "case/large_capture/closing/long/threads:1",
                 {"element_updates_per_second": 3e8 / 1.2}, {"element_updates_per_second": 3e8 / 1.4}, "1.20 times"),
                ("large_capture closing, 16 threads", "case/large_capture/closing/long/threads:16",
                 {"steps_per_second": 1.25e5 * 16 * 0.8}, {"steps_per_second": 1.25e5 * 16 * 0.79}, "0.800"),
                ("Net of 10^6 knots, 1 thread", "growth/1000000/long/threads:1", {"fraction_of_triad": 0.6},
                 {"fraction_of_triad": 0.59}, "60.0 %"),
                ("Growth, 1 thread", "growth/1000000/long/threads:1", {"element_updates_per_second": 4e8},
                 {"element_updates_per_second": 3.9e8}, "1.50 times, at 1,000,000 nodes"),
                ("Memory, net of 10^6 knots", "growth/1000000/long/threads:1", {"bytes_per_item": 250},
                 {"bytes_per_item": 251}, "250 bytes")):
            with self.subTest(part):
                self.assertEqual(row(part, changed({name: good})), [words, "met", ""])
                self.assertEqual(row(part, changed({name: bad}))[1], "missed")

    def test_a_sliding_capture_goes_by_time(self) -> None:
        part = "Capture with sliding joints, until its mouth has closed"
        for factor, verdict in ((1.1, "met"), (1.2, "missed")):
            data = sample.google_json(slower={"case/capture/sliding_until_closed/threads:1": factor})
            self.assertEqual(row(part, data)[1], verdict)

    def test_start_up_goes_by_time(self) -> None:
        name = "startup/capture"
        for factor, verdict in ((0.15, "met"), (0.2, "missed")):
            self.assertEqual(row("Start-up, capture", sample.google_json(slower={name: factor}))[1], verdict)
        self.assertEqual(row("Start-up, net of 10^6 knots", sample.google_json())[1], "met")

    def test_where_a_hand_over_is_long_two_threads_must_not_lose(self) -> None:
        name = f"{CLOSING}/threads:2"  # sample's hand-over takes 180 ns, one thread 0.25 minutes
        for minutes, verdict in ((0.25, "met"), (0.26, "missed")):
            found = row("Capture closing, 2 threads", changed({name: {"minutes_per_simulated_second": minutes}}))
            self.assertEqual(found[1], verdict)
            self.assertIn("of one thread's time, hand-over 180 ns", str(found[0]))

    def test_absent_features_go_by_the_worst(self) -> None:
        self.assertEqual(row("Absent features", sample.google_json(), sample.INSTRUCTIONS), ["0.100 %", "met", ""])
        many = {"features": {**sample.INSTRUCTIONS["features"], "probes": {"counted": 1006, "stripped": 1000}}}
        self.assertEqual(row("Absent features", sample.google_json(), many)[1], "missed")
        self.assertEqual(row("Absent features", sample.google_json()), ["–", "not measured", "bench/count"])

    def test_another_instruction_set_is_told(self) -> None:
        for isa, told in (("v3", True), ("v4", False)):
            caption = targets.figure(sample.run_of(sample.google_json(isa=isa)), None).caption
            self.assertEqual("This run's instruction set is v3." in caption, told)
            self.assertIn("before the first line was written", caption)


class Bits(unittest.TestCase):
    def verdicts(self, data: dict[str, Any]) -> dict[str, str]:
        return {str(row[0]): row[3].words for row in bits.figure(sample.run_of(data)).rows
                if isinstance(row[3], Badge)}

    def test_one_hash_for_all_threads(self) -> None:
        verdicts = self.verdicts(sample.google_json())
        self.assertEqual(verdicts["capture, whole"], "same")
        self.assertEqual(verdicts["ring_pull, sliding"], "one number of threads only")
        self.assertEqual(row("Bits", sample.google_json())[:2], ["the same in 6 scenes", "met"])
        self.assertEqual(bits.differences(sample.run_of(sample.google_json())), [])

    def test_another_hash_with_more_threads_is_an_alarm(self) -> None:
        data = changed({f"{CLOSING}/threads:8": {"label": "0x<1>"}})
        self.assertEqual(self.verdicts(data)["capture, closing"], "DIFFERS")
        self.assertEqual(row("Bits", data)[:2], ["1 of 10 scenes differ", "missed"])
        self.assertRegex(lead.alarms(sample.run_of(data)),
                         '<p class="alarm">case/capture/closing came to different bits: 0x[0-9a-f]{16} with 1, 2, 4, 16 '
                         "threads; 0x&lt;1&gt; with 8 threads</p>")

    def test_another_hash_in_one_repetition_is_a_difference(self) -> None:
        data = sample.google_json(only="case/ring_pull/sliding")
        data["benchmarks"][3]["label"] = "0x1"
        self.assertEqual(self.verdicts(data), {"ring_pull, sliding": "DIFFERS"})

    def test_other_suites_may_label_what_they_like(self) -> None:
        data = changed({"growth/1024/threads:2": {"label": "b"}, "growth/1024/threads:1": {"label": "a"}})
        self.assertEqual(bits.differences(sample.run_of(data)), [])


if __name__ == "__main__":
    unittest.main()
