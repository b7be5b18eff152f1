"""The page in a browser: every curve and bar is there to be seen, in light and in dark.

A script added to the page counts the pixels of each dataset's colour inside its chart. Charts that are emptied on
purpose show that the test would notice.
"""
from __future__ import annotations

import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
import browser
import sample

# Pixels count when colour and opacity fit: bands have the colour of their curve, but let the paper through.
COUNT_PIXELS = """<script>
function inside(chart, colour) {
  const {left, top, width, height} = chart.chartArea, scale = chart.currentDevicePixelRatio;
  return count(chart.ctx, left * scale, top * scale, width * scale, height * scale, colour);
}
function look() {
  const seen = [];
  for (const canvas of document.querySelectorAll('canvas')) {
    const chart = Chart.getChart(canvas), title = canvas.getAttribute('aria-label');
    if (!chart || !chart.data.datasets.length) seen.push([title, 'no chart', 0]);
    else for (const set of chart.data.datasets) {
      if (set.label) seen.push([title, set.label, inside(chart, set.backgroundColor)]);
    }
  }
  tell({seen});
}
window.addEventListener('load', () => setTimeout(look, 500));
</script>"""

HIDE_ONE_CURVE = """<script>
const broken = Chart.getChart(document.querySelector('canvas[aria-label="Speed-up with threads"]'));
broken.data.datasets[2].data = [];
broken.update('none');
</script>"""

WIPE_ONE_CHART = """<script>
const wiped = document.querySelector('canvas[aria-label="Kernels"]');
wiped.getContext('2d').clearRect(0, 0, wiped.width, wiped.height);
</script>"""


@unittest.skipUnless(browser.CHROMIUM, browser.NEEDED)
class Browser(unittest.TestCase):
    folder: Path
    page: str

    @classmethod
    def setUpClass(cls) -> None:
        temporary = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        cls.page = sample.store_page(cls.folder).read_text(encoding="utf-8")

    def look(self, sabotage: str = "", dark: bool = False) -> dict[str, Any]:
        """What a browser sees of the page."""
        return browser.visit(self.page, sabotage + COUNT_PIXELS, self.folder, ["--disable-gpu"], dark)

    def unseen(self, verdict: dict[str, Any]) -> list[tuple[str, str]]:
        return [(title, label) for title, label, pixels in verdict["seen"] if pixels < browser.LEAST_PIXELS]

    def test_every_curve_is_seen(self) -> None:
        for dark in (False, True):
            verdict = self.look(dark=dark)
            self.assertEqual(self.unseen(verdict), [])
            titles = {title for title, _, _ in verdict["seen"]}
            # 16 figures of the run, one of the study, four of the matrix, a history for each of two machines
            self.assertEqual(len(titles), 23, titles)

    def test_an_emptied_curve_would_be_noticed(self) -> None:
        self.assertEqual(self.unseen(self.look(HIDE_ONE_CURVE)), [("Speed-up with threads", "capture, whole")])

    def test_a_wiped_chart_would_be_noticed(self) -> None:
        self.assertEqual(self.unseen(self.look(WIPE_ONE_CHART)), [("Kernels", "kernel")])


if __name__ == "__main__":
    unittest.main()
