"""The stability matrix in part: what the program writes is the page's, verdicts are counted, a choice is kept."""
from __future__ import annotations

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import sample  # finds bench's modules
from page import stability

PROGRAM = os.environ.get("CINCH_STABILITY")


@unittest.skipUnless(PROGRAM, "CINCH_STABILITY names the program")
class Stability(unittest.TestCase):
    matrix: stability.Matrix
    table: str

    @classmethod
    def setUpClass(cls) -> None:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([str(PROGRAM), folder, "--only", "slack"], capture_output=True, check=True, text=True)
            matrix = stability.read_stability(Path(folder) / "stability.json")
        assert matrix
        cls.matrix, cls.table = matrix, done.stdout

    def test_verdicts_are_counted(self) -> None:
        cells = self.matrix["cells"]
        names = {group["name"] for group in self.matrix["groups"]}
        self.assertEqual(names, {cell["group"] for cell in cells})
        for verdict in ("held", "stopped", "FAILED"):
            self.assertEqual(sum(group[verdict.lower()] for group in self.matrix["groups"]),
                             sum(cell["verdict"] == verdict for cell in cells), verdict)
        self.assertGreater(sum(cell["verdict"] == "stopped" for cell in cells), 3)

    def test_what_stopped_names_thread_time_and_cause(self) -> None:
        for cell in self.matrix["cells"]:
            if cell["verdict"] == "stopped":
                self.assertRegex(cell["message"], r"at t = [0-9.e-]+ s .* of thread\.main .*likely cause: ")

    def test_the_table_says_the_same(self) -> None:
        rows = [line for line in self.table.splitlines() if line.startswith("| slack and taut | ")]
        cells = [f'| {cell["group"]} | {cell["parameter"]} | {cell["value"]} | {cell["must"]} | {cell["verdict"]} |'
                 for cell in self.matrix["cells"] if cell["group"] == "slack and taut"]
        self.assertEqual([row[:len(cell)] for row, cell in zip(rows, cells)], cells)

    def test_the_page_draws_it(self) -> None:
        drawn = {figure.title: figure for figure in stability.figures(self.matrix)}
        self.assertEqual(len(drawn["Stability matrix: verdicts"].rows), len(self.matrix["cells"]))
        curves = drawn["Energy residual of a thread that turns slack and taut"].chart["series"]
        self.assertEqual(len(curves), 6)
        self.assertEqual({len(curve["values"]) for curve in curves}, {5})

    def test_a_wrong_argument_is_refused(self) -> None:
        done = subprocess.run([str(PROGRAM), "--all"], capture_output=True, check=False, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertTrue(done.stderr.startswith("usage: "))


if __name__ == "__main__":
    unittest.main()
