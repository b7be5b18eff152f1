"""The page in a browser: every curve and bar is there to be seen, in light and in dark.

A script added to a copy of the page counts the pixels of each dataset's colour inside its chart and writes the counts
into the page, which Chromium prints. Charts that are emptied on purpose show that the test would notice.
"""
from __future__ import annotations

import json
import re
import shutil
import subprocess
import tempfile
import unittest
from html import unescape
from pathlib import Path
from typing import Any

import sample

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
LEAST_PIXELS = 25  # fewer could be the edge of a neighbour

NOTE_ERRORS = """<script>
window.pageErrors = [];
window.addEventListener('error', event => window.pageErrors.push(event.message));
</script>"""

# Pixels count when colour and opacity fit: bands have the colour of their curve, but let the paper through.
COUNT_PIXELS = """<script>
function rgba(colour) {
  const context = document.createElement('canvas').getContext('2d');
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data];
}
function count(chart, colour) {
  const {left, top, width, height} = chart.chartArea, scale = chart.currentDevicePixelRatio;
  const {data} = chart.ctx.getImageData(left * scale, top * scale, width * scale, height * scale);
  let pixels = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (colour.every((value, k) => Math.abs(data[i + k] - value) <= 12)) pixels++;
  }
  return pixels;
}
function look() {
  const seen = [];
  for (const canvas of document.querySelectorAll('canvas')) {
    const chart = Chart.getChart(canvas), title = canvas.getAttribute('aria-label');
    if (!chart || !chart.data.datasets.length) seen.push([title, 'no chart', 0]);
    else for (const set of chart.data.datasets) {
      if (set.label) seen.push([title, set.label, count(chart, rgba(set.backgroundColor))]);
    }
  }
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  const verdict = document.createElement('pre');
  verdict.id = 'verdict';
  verdict.textContent = JSON.stringify({seen, dark, errors: window.pageErrors});
  document.body.append(verdict);
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


@unittest.skipUnless(CHROMIUM, "no browser; to have one: apt-get install chromium")
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
        copy = self.folder / "copy.html"
        text = self.page.replace("<head>", "<head>" + NOTE_ERRORS, 1)
        copy.write_text(text.replace("</body>", sabotage + COUNT_PIXELS + "</body>"), encoding="utf-8")
        done = subprocess.run(
            [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             f"--user-data-dir={self.folder / 'profile'}", "--window-size=1280,1000", "--virtual-time-budget=5000",
             f"--blink-settings=preferredColorScheme={0 if dark else 1}", "--dump-dom", copy.as_uri()],
            capture_output=True, text=True, timeout=300, check=False)
        found = re.search(r'<pre id="verdict">(.*?)</pre>', done.stdout, re.DOTALL)
        if not found:
            self.fail(f"the browser printed no verdict:\n{done.stderr[-2000:]}")
        verdict: dict[str, Any] = json.loads(unescape(found[1]))
        self.assertEqual(verdict["errors"], [])
        self.assertEqual(verdict["dark"], dark)
        return verdict

    def unseen(self, verdict: dict[str, Any]) -> list[tuple[str, str]]:
        return [(title, label) for title, label, pixels in verdict["seen"] if pixels < LEAST_PIXELS]

    def test_every_curve_is_seen(self) -> None:
        for dark in (False, True):
            verdict = self.look(dark=dark)
            self.assertEqual(self.unseen(verdict), [])
            titles = {title for title, _, _ in verdict["seen"]}
            # 13 figures of the run, one of the study, four of the matrix, a history for each of two machines
            self.assertEqual(len(titles), 20, titles)

    def test_an_emptied_curve_would_be_noticed(self) -> None:
        self.assertEqual(self.unseen(self.look(HIDE_ONE_CURVE)), [("Speed-up with threads", "capture, whole")])

    def test_a_wiped_chart_would_be_noticed(self) -> None:
        self.assertEqual(self.unseen(self.look(WIPE_ONE_CHART)), [("Kernels", "kernel")])


if __name__ == "__main__":
    unittest.main()
