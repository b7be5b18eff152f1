"""The report of a capture in a browser: its curves are there to be seen, its net moves and turns, in light and in dark.

A script added to the page looks at charts and net as a reader would, works the controls, and tells what it has seen.
"""
from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "support"))
import browser

PROGRAM = os.environ.get("CINCH_PROGRAM")
CASE = Path(__file__).parents[2] / "cases" / "capture.toml"

LOOK = """<script>
function charts() {
  const seen = [];
  for (const canvas of document.querySelectorAll('canvas[data-plot]')) {
    const chart = Chart.getChart(canvas), title = canvas.getAttribute('aria-label');
    if (!chart || !chart.data.datasets.length) { seen.push([title, 'no chart', 0]); continue; }
    for (const set of chart.data.datasets) {  // each alone: others may lie on it
      chart.data.datasets.forEach(other => { other.hidden = other !== set; });
      chart.update('none');
      const pixels = count(chart.ctx, 0, 0, canvas.width, canvas.height, set.borderColor);
      seen.push([title, set.label, set.data.some(point => point.y !== null) ? pixels : -1]);
    }
  }
  return seen;
}
// What the net's canvas shows: in the frame in which it is drawn, as it is empty afterwards.
function net() {
  const canvas = document.querySelector('#view canvas'), slider = document.getElementById('view-time');
  return new Promise(resolve => {
    slider.dispatchEvent(new Event('input'));
    requestAnimationFrame(() => {
      const copy = document.createElement('canvas');
      copy.width = canvas.width, copy.height = canvas.height;
      copy.getContext('2d').drawImage(canvas, 0, 0);
      const {data} = copy.getContext('2d').getImageData(0, 0, copy.width, copy.height);
      let pixels = 0, sum = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (data[i + 3] === 0) continue;
        pixels++;
        sum = (sum * 31 + i + data[i] + 256 * data[i + 1] + 65536 * data[i + 2]) % 1000000007;
      }
      resolve({pixels, sum, label: document.getElementById('view-label').textContent});
    });
  });
}
const wait = milliseconds => new Promise(resolve => setTimeout(resolve, milliseconds));
async function look() {
  const seen = {charts: charts()};
  const canvas = document.querySelector('#view canvas'), slider = document.getElementById('view-time');
  seen.last = await net();
  slider.value = 0;
  seen.first = await net();
  slider.value = slider.max;
  seen.again = await net();
  const press = key => canvas.dispatchEvent(new KeyboardEvent('keydown', {key}));
  press('ArrowLeft'), press('ArrowUp');
  seen.turned = await net();
  canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: 100}));
  seen.far = await net();
  canvas.dispatchEvent(new MouseEvent('dblclick'));
  seen.back = await net();
  const button = document.getElementById('view-play');
  button.click();
  await wait(350);
  seen.playing = [button.textContent, document.getElementById('view-label').textContent];
  button.click();
  seen.stopped = button.textContent;
  seen.gaps = [...document.querySelectorAll('#view .gap')].filter(gap => !gap.hidden).map(gap => gap.textContent);
  tell(seen);
}
window.addEventListener('load', () => setTimeout(look, 500));
</script>"""


@unittest.skipUnless(PROGRAM, "CINCH_PROGRAM names the program")
@unittest.skipUnless(browser.CHROMIUM, browser.NEEDED)
class Page(unittest.TestCase):
    folder: Path
    page: str
    bright: dict[str, Any]  # what is seen in light

    @classmethod
    def setUpClass(cls) -> None:
        temporary = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        sets = ["case.method=sliding", "time.step_s=auto", "closing.time_s=1.2", "time.end_s=1.5",
                "output.frame_interval_s=0.05", "output.probe_interval_s=0.01"]
        sets += [f"thread.{thread}.elements=12" for thread in ("c_top", "c_right", "c_bottom", "c_left")]
        options = [word for key in sets for word in ("--set", key)]
        result = cls.folder / "result"
        subprocess.run([str(PROGRAM), "run", str(CASE), "--quiet", "--out", str(result), *options],
                       check=True, capture_output=True)
        subprocess.run([str(PROGRAM), "report", str(result)], check=True, capture_output=True)
        cls.page = (result / "report.html").read_text(encoding="utf-8")
        cls.bright = cls.look()

    @classmethod
    def look(cls, dark: bool = False, page: str = "") -> dict[str, Any]:
        """What a browser sees of the page, drawn by the processor: WebGL wants no graphics card then."""
        return browser.visit(page or cls.page, LOOK, cls.folder,
                             ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"], dark)

    def test_curves_are_seen(self) -> None:
        for seen in (self.bright, self.look(dark=True)):
            titles = {title for title, _, _ in seen["charts"]}
            self.assertGreaterEqual(len(titles), 6, titles)
            unseen = [(title, label) for title, label, pixels in seen["charts"] if 0 <= pixels < browser.LEAST_PIXELS]
            self.assertEqual(unseen, [])

    def test_the_net_moves_and_turns(self) -> None:
        seen = self.bright
        self.assertEqual(seen["gaps"], [])
        self.assertEqual((seen["first"]["label"], seen["last"]["label"]), ("t = 0.000 s", "t = 1.500 s"))
        self.assertEqual(seen["again"], seen["last"])
        self.assertEqual(seen["back"], seen["last"], "a double click starts over")
        sums = {seen[view]["sum"] for view in ("last", "first", "turned", "far")}
        self.assertEqual(len(sums), 4, "each view differs")
        self.assertLess(seen["far"]["pixels"], seen["turned"]["pixels"])
        self.assertEqual(seen["playing"][0], "Pause")
        self.assertNotEqual(seen["playing"][1], "t = 1.500 s")
        self.assertEqual(seen["stopped"], "Play")

    def test_threads_are_drawn(self) -> None:
        without = self.page.replace("scene.add(lines);", "", 1)
        self.assertNotEqual(without, self.page)
        bodies = self.look(page=without)["last"]["pixels"]
        self.assertGreater(bodies, 500)
        self.assertGreater(self.bright["last"]["pixels"], 1.2 * bodies)


if __name__ == "__main__":
    unittest.main()
