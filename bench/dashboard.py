#!/usr/bin/env python3
"""Draws a stored run and the history as one HTML page that needs no network and no server:

    bench/dashboard.py RUN [--history FILE] [--instructions FILE] [--study FILE]
                       [--stability FILE] [--out FILE]

The page's style is that of `cinch report`; numbers, captions and tables are written here, dashboard.js draws.
"""
from __future__ import annotations

import json
from datetime import datetime, timezone
from html import escape
from pathlib import Path
from typing import Any, Sequence

import history
from command_line import BadInput, Parser, run_main
from page import cases, over_time, parts, precision, scaling, stability
from page.figure import Cell, Chart, Figure, Row
from paper_times import MACHINE
from stored_run import Run, parse_json, read_run, read_text
from text import duration, number

HERE = Path(__file__).resolve().parent
REPORT_CSS = HERE.parent / "src/report/page.css"
CHART_JS = Path("/usr/share/javascript/chart.js/chart.min.js")  # Debian's libjs-chart.js


def sections(run: Run, instructions: parts.Instructions, counted_on: str,
             study: precision.Study | None, matrix: stability.Matrix | None) -> list[tuple[str, list[Figure]]]:
    """All figures of one run, in the order of the page."""
    return [
        ("Cases", [cases.run_time(run), cases.stages(run)]),
        ("Error against run time", precision.figures(study)),
        ("Stability", stability.figures(matrix)),
        ("Threads", [scaling.speed_up(run), scaling.efficiency(run), scaling.hand_over(run), scaling.triad(run)]),
        ("Growth", [scaling.growth(run), scaling.triad_share(run)]),
        ("Parts of a step", [parts.element(run), parts.absent(run, instructions, counted_on), parts.kernels(run)]),
        ("Memory, start-up and output", [scaling.memory(run), parts.around(run)]),
    ]


def tag(name: str, inside: str, look: str = "") -> str:
    return f'<{name} class="{look}">{inside}</{name}>' if look else f"<{name}>{inside}</{name}>"


def cell(value: Cell) -> str:
    """A cell of a table: numbers to the right, a dash for what was not measured."""
    if isinstance(value, str):
        return tag("td", escape(value))
    words = "–" if value is None else f"{value:,}" if isinstance(value, int) else number(value)
    return tag("td", words, "n")


def table(headers: list[str], rows: Sequence[Row]) -> str:
    """A table whose numeric columns stand to the right."""
    numeric = [all(not isinstance(row[i], str) for row in rows) for i in range(len(headers))]
    head = "".join(tag("th", escape(words), "n" if right else "") for words, right in zip(headers, numeric))
    body = "".join(tag("tr", "".join(map(cell, row))) + "\n" for row in rows)
    return tag("div", tag("table", tag("thead", tag("tr", head)) + tag("tbody", body)), "scroll tall")


def canvas(title: str, attribute: str, height: int) -> str:
    return (f'<div class="canvas" style="height:{height}px"><canvas role="img" aria-label="{escape(title)}" '
            f"{attribute}></canvas></div>")


def chart_height(chart: Chart) -> int:
    """Bars get as much room as there are of them."""
    if chart["type"] == "line":
        return 310
    each = 1 if chart["stacked"] else len(chart["series"])
    return max(150, 84 + len(chart["categories"]) * (12 * each + 12))


def figure_html(figure: Figure, index: int) -> str:
    """One figure, or what to do to have it measured."""
    title = tag("h3", escape(figure.title))
    if not figure.rows or not figure.chart["series"]:
        gap = f"Not measured in this run. To measure it: {tag('code', escape(figure.command))}"
        return tag("figure", title + tag("p", gap, "gap"), "plot")
    drawn = canvas(figure.title, f'data-figure="{index}"', chart_height(figure.chart))
    numbers = tag("details", "<summary>Numbers</summary>" + table(figure.headers, figure.rows))
    return tag("figure", title + drawn + tag("figcaption", escape(figure.caption)) + numbers, "plot")


def lead(run: Run) -> str:
    """Title, the headline against the paper, and what was measured on what."""
    words = ("Speed of the solver, measured by <code>bench/run</code>. Times are medians over the repetitions; those "
             "of an element, a kernel or an absent feature are the processor's, which other programs do not lengthen.")
    beside = cases.times_faster(run)
    badges = " ".join(tag("span", f"{escape(case)}: {number(ratio)} times faster",
                          "badge good" if ratio > 1 else "badge poor") for case, ratio in beside)
    paper = tag("p", f"Against the paper's run times on a {MACHINE}: {badges}", "counts") if beside else ""
    gave_up = "".join(tag("p", f"{escape(result.name)} gave up: {escape(result.error)}", "alarm")
                      for result in run.results.values() if result.error)
    return tag("h1", "Cinch benchmarks") + tag("p", words, "about") + paper + gave_up + facts(run)


def facts(run: Run) -> str:
    """On what and of what the run was made."""
    handover = run.handover_ns()
    repetitions = max((len(result.seconds) for result in run.results.values()), default=0)
    changes = " with changes" if run.about("dirty") == "yes" else ""
    date = run.date.replace("T", " ").replace("Z", " UTC")
    rows = [("Run", f"{date}, {run.about('mode')}"), ("Commit", run.about("commit") + changes),
            ("Machine", f"{run.machine_id}, {run.about('cores')} cores"), ("Instruction set", run.about("isa")),
            ("Compiler", f"{run.about('compiler')}, {run.about('build_type')}"),
            ("Hand-over between threads", duration(handover * 1e-9) if handover else "not measured in this run"),
            ("Repetitions", f"{repetitions}" + ("; ranges need bench/run --full" if repetitions < 2 else ""))]
    body = "".join(tag("tr", tag("th", what) + tag("td", escape(words))) for what, words in rows)
    return tag("div", tag("table", tag("tbody", body), "facts"), "scroll")


def history_html(points: dict[str, dict[str, list[over_time.Point]]]) -> str:
    """A chooser of the benchmark, then a figure for each place; dashboard.js fills them."""
    benchmarks = sorted({benchmark for place in points.values() for benchmark in place})
    if not benchmarks:
        return tag("p", f"No history yet. To begin one: {tag('code', 'bench/run')}", "gap")
    first = over_time.first_choice(benchmarks)
    options = "".join(f'<option{" selected" if name == first else ""}>{escape(name)}</option>' for name in benchmarks)
    chooser = f'<p><label>Benchmark <select id="history-benchmark">{options}</select></label></p>'
    figures = "".join(place_html(place, points[place]) for place in points)
    return chooser + tag("div", figures, "plots")


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
    return tag("details", f"<summary>Latest commit against the one before: {counts}</summary>" +
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


def render(run: Run, records: list[history.Record], instructions: parts.Instructions, counted_on: str,
           chart_js: str, study: precision.Study | None = None, matrix: stability.Matrix | None = None) -> str:
    """The whole page."""
    body = lead(run)
    figures: list[Figure] = []
    for heading, group in sections(run, instructions, counted_on, study, matrix):
        drawn = "".join(figure_html(figure, index) for index, figure in enumerate(group, len(figures)))
        body += tag("h2", heading) + tag("div", drawn, "plots")
        figures += group
    points = over_time.points(records)
    body += tag("h2", "History") + history_html(points) + tag("h2", "The numbers elsewhere") + exports_html()
    style = REPORT_CSS.read_text(encoding="utf-8") + (HERE / "page/dashboard.css").read_text(encoding="utf-8")
    scripts = "".join(tag("script", script_safe(text)) + "\n"
                      for text in (chart_js, (HERE / "page/dashboard.js").read_text(encoding="utf-8")))
    data = as_json("figures", [figure.chart for figure in figures]) + as_json(
        "history", {place: over_time.chart_data(benchmarks) for place, benchmarks in points.items()})
    return ('<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n<link rel="icon" href="data:,">\n'
            f"<title>Cinch benchmarks, {escape(run.about('commit'))}</title>\n<style>\n{style}</style>\n</head>\n"
            f"<body>\n<main>\n{body}\n</main>\n{data}{scripts}</body>\n</html>\n")


def read_instructions(path: Path | None) -> tuple[parts.Instructions, str]:
    """Instruction counts of absent features and the day they were counted; nothing when there is no such file."""
    if path is None or not path.exists():
        return {}, ""
    data = parse_json(read_text(path), str(path))
    if not isinstance(data, dict):
        raise BadInput(f"{path}: must hold an object of features")
    for feature, counts in data.items():
        known = isinstance(counts, dict) and all(isinstance(counts.get(key), (int, float))
                                                 for key in ("counted", "stripped"))
        if not known:
            raise BadInput(f'{path}: "{feature}" must hold the numbers "counted" and "stripped"')
    return data, datetime.fromtimestamp(path.stat().st_mtime, timezone.utc).strftime("%Y-%m-%d")


def main() -> int:
    parser = Parser(prog="bench/dashboard.py", description="Draws a stored run and the history as one HTML page.")
    parser.add_argument("run", type=Path, metavar="RUN", help="stored run: Google Benchmark's JSON")
    parser.add_argument("--history", type=Path, help="history.jsonl")
    parser.add_argument("--instructions", type=Path, help="instruction counts of absent features, JSON")
    parser.add_argument("--study", type=Path, help="study.json of bench/study")
    parser.add_argument("--stability", type=Path, help="stability.json of bench/stability")
    parser.add_argument("--out", type=Path, default=Path("dashboard.html"), help="page to write")
    parser.add_argument("--chart-js", type=Path, default=CHART_JS, help="Chart.js 3 (default: Debian's libjs-chart.js)")
    given = parser.parse_args()
    if not given.chart_js.exists():
        raise BadInput(f"{given.chart_js}: no such file; apt-get install libjs-chart.js")
    instructions, counted_on = read_instructions(given.instructions)
    records = history.read(given.history) if given.history else []
    text = render(read_run(given.run), records, instructions, counted_on, read_text(given.chart_js),
                  precision.read_study(given.study), stability.read_stability(given.stability))
    given.out.write_text(text, encoding="utf-8")
    print(f"dashboard: {given.out}")
    return 0


if __name__ == "__main__":
    run_main(main)
