"""Figures and their parts as HTML."""
from __future__ import annotations

from html import escape
from typing import Sequence

from page.figure import Badge, Cell, Chart, Figure, Row
from text import number


def tag(name: str, inside: str, look: str = "") -> str:
    return f'<{name} class="{look}">{inside}</{name}>' if look else f"<{name}>{inside}</{name}>"


def cell(value: Cell) -> str:
    """A cell of a table: numbers to the right, a dash for what was not measured."""
    if isinstance(value, Badge):
        return tag("td", tag("span", escape(value.words), f"badge {value.look}"))
    if isinstance(value, str):
        return tag("td", escape(value))
    words = "–" if value is None else f"{value:,}" if isinstance(value, int) else number(value)
    return tag("td", words, "n")


def table(headers: list[str], rows: Sequence[Row], look: str = "scroll tall") -> str:
    """A table whose numeric columns stand to the right; a tall one scrolls in its place."""
    numeric = [all(not isinstance(row[i], (str, Badge)) for row in rows) for i in range(len(headers))]
    head = "".join(tag("th", escape(words), "n" if right else "") for words, right in zip(headers, numeric))
    body = "".join(tag("tr", "".join(map(cell, row))) + "\n" for row in rows)
    return tag("div", tag("table", tag("thead", tag("tr", head)) + tag("tbody", body)), look)


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
    """One figure, or what to do to have it measured. One without a chart is its table."""
    title = tag("h3", escape(figure.title))
    if not figure.rows or figure.chart and not figure.chart["series"]:
        gap = f"Not measured in this run. To measure it: {tag('code', escape(figure.command))}"
        return tag("figure", title + tag("p", gap, "gap"), "plot")
    caption = tag("figcaption", escape(figure.caption))
    numbers = table(figure.headers, figure.rows)
    if not figure.chart:
        return tag("figure", title + caption + numbers, "listing")
    findings = table(*figure.findings, "scroll") if figure.findings else ""
    drawn = canvas(figure.title, f'data-figure="{index}"', chart_height(figure.chart))
    return tag("figure", title + drawn + caption + findings + tag("details", "<summary>Numbers</summary>" + numbers), "plot")
