#!/usr/bin/env python3
"""Draws a stored run and the history as one HTML page that needs no network and no server:

    bench/dashboard.py RUN [--runs FOLDER [--known FILE]] [--history FILE] [--instructions FILE]
                       [--study FILE] [--stability FILE] [--out FILE]

The page's style is that of `cinch report`; numbers, captions and tables are written here, dashboard.js draws.
"""
from __future__ import annotations

import json
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

import history
import newest
from command_line import BadInput, Parser, run_main
from comparison import SINGLE
from page import absent, bits, broadphase, cases, others, over_time, parts, precision, reduction, scaling, stability
from page import targets
from page.figure import Chart, Figure
from page.html import canvas, figure_html, table, tag
from page.lead import lead
from stored_run import Run, read_run, read_text

HERE = Path(__file__).resolve().parent
REPORT_CSS = HERE.parent / "src/report/page.css"
CHART_JS = Path("/usr/share/javascript/chart.js/chart.min.js")  # Debian's libjs-chart.js


@dataclass(frozen=True)
class Found:
    """What other programs have found; none where they have not been run."""

    instructions: absent.Instructions | None = None
    study: precision.Study | None = None
    matrix: stability.Matrix | None = None


def sections(run: Run, found: Found) -> list[tuple[str, list[Figure]]]:
    """All figures of one run, in the order of the page."""
    return [
        ("Targets", [targets.figure(run, found.instructions)]),
        ("Cases", [cases.run_time(run), cases.stages(run), bits.figure(run)]),
        ("Other programs", [others.figure(run)]),
        ("Error against run time", precision.figures(found.study)),
        ("Stability", stability.figures(found.matrix)),
        ("Threads", [scaling.speed_up(run), scaling.efficiency(run), scaling.hand_over(run), scaling.triad(run)]),
        ("Growth", [scaling.growth(run), scaling.triad_share(run)]),
        ("Parts of a step", [parts.element(run), absent.figure(run, found.instructions), parts.kernels(run),
                             reduction.figure(run), broadphase.figure(run)]),
        ("Memory, start-up and output", [scaling.memory(run), parts.around(run)]),
    ]


def history_html(points: dict[str, dict[str, list[over_time.Point]]]) -> str:
    """A chooser of the benchmark, then a figure for each place; dashboard.js fills them."""
    benchmarks = sorted({benchmark for place in points.values() for benchmark in place})
    if not benchmarks:
        return tag("p", f"No history yet. To begin one: {tag('code', 'bench/run')}", "gap")
    first = over_time.first_choice(benchmarks)
    options = "".join(f'<option{" selected" if name == first else ""}>{escape(name)}</option>' for name in benchmarks)
    chooser = f'<p><label>Benchmark <select id="history-benchmark">{options}</select></label></p>'
    figures = "".join(place_html(place, points[place]) for place in points)
    return glance_html(points) + chooser + tag("div", figures, "plots")


def glance_html(points: dict[str, dict[str, list[over_time.Point]]]) -> str:
    """The latest commits at a glance, where there are commits before them."""
    rows = over_time.headlines(points)
    headers = ["case, 1 thread", "before", "median", "latest", "median", "change", "verdict", "place"]
    return tag("div", table(headers, rows), "listing") if rows else ""


def place_html(place: str, benchmarks: dict[str, list[over_time.Point]]) -> str:
    """One place: its curve, the numbers behind it, and what its latest commit changed."""
    title = f"{place}: time of one iteration"
    caption = ("Lower is better; the band spans the fastest and the slowest repetition, and a curve that leaves the "
               "band before it is a change of speed. Runs that repeat nothing have no band.")
    headers = "".join(tag("th", words, look) for words, look in [
        ("commit date", ""), ("commit", ""), ("median", "n"), ("least", "n"), ("greatest", "n"), ("n", "n")])
    numbers = ("<details><summary>Numbers</summary><div class=\"scroll tall\"><table>"
               f"<thead><tr>{headers}</tr></thead><tbody></tbody></table></div></details>")
    return (f'<figure class="plot" data-place="{escape(place)}">' + tag("h3", escape(title)) +
            canvas(title, "data-history", 310) + '<p class="gap" hidden>No such run holds this benchmark.</p>' +
            tag("figcaption", caption) + numbers + changes_html(over_time.latest_changes(benchmarks)) + "</figure>")


def changes_html(changes: list[over_time.Change]) -> str:
    """The latest commit against the one before it, by the rule of bench/compare."""
    if not changes:
        return ""
    counts = ", ".join(f"{sum(change.verdict == verdict for change in changes)} {words}" for verdict, words in
                       [("slower", "slower"), ("faster", "faster"), ("same", "within noise")])
    rows = over_time.change_rows(changes)
    headers = ["benchmark", "before", "median", "latest", "median", "change", "verdict"]
    single = any(not point.spread.repeated for change in changes for point in (change.before, change.after))
    rule = tag("p", f"By the rule of bench/compare {SINGLE}.", "soft small") if single else ""
    return tag("details", f"<summary>Latest commit against the one before: {counts}</summary>" + rule +
               (table(headers, rows) if rows else ""))


def exports_html() -> str:
    """What lies beside the page."""
    return table(["beside this page", "for"], [
        ("bencher.json", "Bencher: bencher run --adapter json --file bencher.json"),
        ("github-action-benchmark.json", "github-action-benchmark: tool customSmallerIsBetter"),
        ("results.csv", "spreadsheets, R, pandas: one line for each benchmark"),
        ("history.jsonl", "all runs: one line of JSON for each benchmark of each run"),
        ("runs/", "Google Benchmark's JSON of each run, for bench/compare A B")])


def script_safe(text: str) -> str:
    """Text that cannot end the script element it stands in."""
    return text.replace("</script", "<\\/script").replace("<!--", "<\\!--")


def as_json(element_id: str, data: Any) -> str:
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c")
    return f'<script type="application/json" id="{element_id}">{text}</script>\n'


def render(run: Run, records: list[history.Record], chart_js: str, found: Found = Found()) -> str:
    """The whole page."""
    body = lead(run)
    charts: list[Chart] = []
    for heading, group in sections(run, found):
        drawn = ""
        for figure in group:
            drawn += figure_html(figure, len(charts))
            charts += [figure.chart] if figure.chart else []
        body += tag("h2", heading) + tag("div", drawn, "plots")
    points = over_time.points(records)
    body += tag("h2", "History") + history_html(points) + tag("h2", "The numbers elsewhere") + exports_html()
    style = REPORT_CSS.read_text(encoding="utf-8") + (HERE / "page/dashboard.css").read_text(encoding="utf-8")
    scripts = "".join(tag("script", script_safe(text)) + "\n"
                      for text in (chart_js, (HERE / "page/dashboard.js").read_text(encoding="utf-8")))
    data = as_json("figures", charts) + as_json(
        "history", {place: over_time.chart_data(benchmarks) for place, benchmarks in points.items()})
    return ('<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n<link rel="icon" href="data:,">\n'
            f"<title>Cinch benchmarks, {escape(run.about('commit'))}</title>\n<style>\n{style}</style>\n</head>\n"
            f"<body>\n<main>\n{body}\n</main>\n{data}{scripts}</body>\n</html>\n")


def main() -> int:
    parser = Parser(prog="bench/dashboard.py", description="Draws a stored run and the history as one HTML page.")
    parser.add_argument("run", type=Path, metavar="RUN", help="stored run: Google Benchmark's JSON")
    parser.add_argument("--runs", type=Path, metavar="FOLDER", help="stored runs: what RUN lacks comes from the newest "
                        "of them that was made in the same place")
    parser.add_argument("--known", type=Path, metavar="FILE", help="names of the program's benchmarks, one a line: "
                        "others are not taken from --runs")
    parser.add_argument("--history", type=Path, help="history.jsonl")
    parser.add_argument("--instructions", type=Path, help="instruction counts of absent features, JSON")
    parser.add_argument("--study", type=Path, help="study.json of bench/study")
    parser.add_argument("--stability", type=Path, help="stability.json of bench/stability")
    parser.add_argument("--out", type=Path, default=Path("dashboard.html"), help="page to write")
    parser.add_argument("--chart-js", type=Path, default=CHART_JS, help="Chart.js 3 (default: Debian's libjs-chart.js)")
    given = parser.parse_args()
    if not given.chart_js.exists():
        raise BadInput(f"{given.chart_js}: no such file; apt-get install libjs-chart.js")
    records = history.read(given.history) if given.history else []
    found = Found(absent.read_instructions(given.instructions), precision.read_study(given.study),
                  stability.read_stability(given.stability))
    run = read_run(given.run)
    if given.runs:
        run = newest.with_older(run, given.runs, newest.known_names(given.known) if given.known else None)
    text = render(run, records, read_text(given.chart_js), found)
    given.out.write_text(text, encoding="utf-8")
    print(f"dashboard: {given.out}")
    return 0


if __name__ == "__main__":
    run_main(main)
