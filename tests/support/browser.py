"""A page in a browser, opened from disk as users do: a script added to it looks around and tells what it has seen to a
server on this machine.

The browser's own clock counts: with a virtual one Chromium ends before frames are drawn, where the machine is busy.
"""
from __future__ import annotations

import json
import os
import queue
import shutil
import signal
import subprocess
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
NEEDED = "no browser; to have one: apt-get install chromium"
LEAST_PIXELS = 25  # fewer could be the edge of a neighbour

NOTE_ERRORS = """<script>
window.pageErrors = [];
window.addEventListener('error', event => window.pageErrors.push(event.message));
window.addEventListener('unhandledrejection', event => tell({failed: window.pageErrors.push(String(event.reason))}));
</script>"""

# What scripts look with: pixels of a colour within a part of a canvas, and `tell`, which ends the visit.
TOOLS = """<script>
function rgba(colour) {
  const context = document.createElement('canvas').getContext('2d');
  context.fillStyle = colour;
  context.fillRect(0, 0, 1, 1);
  return [...context.getImageData(0, 0, 1, 1).data];
}
function count(context, left, top, width, height, colour) {
  const {data} = context.getImageData(left, top, width, height), wanted = rgba(colour);
  let pixels = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (wanted.every((value, k) => Math.abs(data[i + k] - value) <= 12)) pixels++;
  }
  return pixels;
}
function tell(seen) {
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  const body = JSON.stringify({...seen, dark, address: location.href, errors: window.pageErrors});
  fetch('LISTENER', {method: 'POST', mode: 'no-cors', body}).catch(error => console.error(String(error)));
}
</script>"""


def listen(told: queue.Queue[bytes]) -> ThreadingHTTPServer:
    """A server on this machine that puts what is posted to it into `told`."""
    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            told.put(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(204)
            self.end_headers()

        def log_message(self, format: str, *args: Any) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def visit(page: str, script: str, folder: Path, options: list[str], dark: bool = False) -> dict[str, Any]:
    """What `script` tells of the page, in light or dark. AssertionError for errors on the page, and where it tells
    nothing."""
    told: queue.Queue[bytes] = queue.Queue()
    file = folder / "visited.html"
    with listen(told) as server, (folder / "browser.log").open("w") as log:
        tools = TOOLS.replace("LISTENER", f"http://127.0.0.1:{server.server_port}/")
        text = page.replace("<head>", "<head>" + NOTE_ERRORS, 1).replace("</body>", tools + script + "</body>")
        file.write_text(text, encoding="utf-8")
        browser = subprocess.Popen(
            [str(CHROMIUM), "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--no-proxy-server", *options,
             f"--user-data-dir={folder / 'profile'}", "--window-size=1280,1000", "--remote-debugging-port=0",
             "--enable-logging=stderr", "--disable-features=LocalNetworkAccessChecks",  # a page may tell this machine
             f"--blink-settings=preferredColorScheme={0 if dark else 1}", file.resolve().as_uri()],
            stdout=log, stderr=log, start_new_session=True)
        try:
            seen: dict[str, Any] = json.loads(told.get(timeout=120))
        except queue.Empty:
            raise AssertionError(f"the page told nothing:\n{(folder / 'browser.log').read_text()[-2000:]}") from None
        finally:
            os.killpg(browser.pid, signal.SIGKILL)  # with the processes that it has started
            browser.wait()
            server.shutdown()
    if seen["errors"] or seen["dark"] != dark or not seen["address"].startswith("file://"):
        raise AssertionError(f"errors: {seen['errors']}, dark: {seen['dark']}, opened from {seen['address']}")
    return seen
