"""The top of the page: the headline, what went wrong, and on what and of what the run was made."""
from __future__ import annotations

from html import escape

import verdict
from page import cases
from page.html import tag
from paper_times import MACHINE
from stored_run import Run
from text import duration, number

QUICK = ("Quick runs leave out nets of 10^6 nodes, large_capture's closing and whole, and whole cases on several "
         "threads, unless a filter names them, and repeat nothing: bench/run --full has them all, with ranges.")


def lead(run: Run) -> str:
    """Title, the headline against the paper, alarms, and what was measured on what."""
    words = ("Speed of the solver, measured by <code>bench/run</code>. Times are medians over the repetitions; those "
             "of an element, a kernel or an absent feature are the processor's, which other programs do not lengthen.")
    beside = cases.times_faster(run)
    badges = " ".join(tag("span", f"{escape(case)}: {number(ratio)} times faster",
                          "badge good" if ratio > 1 else "badge poor") for case, ratio in beside)
    paper = tag("p", f"Against the paper's run times on a {MACHINE}: {badges}", "counts") if beside else ""
    quick = tag("p", QUICK, "about") if run.about("mode") == "quick" else ""
    return tag("h1", "Cinch benchmarks") + tag("p", words, "about") + paper + alarms(run) + facts(run) + quick


def alarms(run: Run) -> str:
    """Bits that differ, benchmarks that gave up."""
    return "".join(tag("p", escape(words), "alarm") for words in verdict.verdict(run)[1])


def facts(run: Run) -> str:
    """On what and of what the run was made."""
    handover = run.handover_ns()
    repetitions = max((len(result.seconds) for result in run.results.values()), default=0)
    date = run.date.replace("T", " ").replace("Z", " UTC")
    rows = [("Run", f"{date}, {run.about('mode')}"), ("Commit", run.commit), *_older(run),
            ("Machine", f"{run.machine_id}, {run.about('cores')} cores"), ("Instruction set", run.about("isa")),
            ("Compiler", f"{run.about('compiler')}, {run.about('build_type')}"),
            ("Hand-over between threads", duration(handover * 1e-9) if handover else "not measured in this run"),
            ("Repetitions", f"{repetitions}" + ("; ranges need bench/run --full" if repetitions < 2 else ""))]
    body = "".join(tag("tr", tag("th", what) + tag("td", escape(words))) for what, words in rows)
    return tag("div", tag("table", tag("tbody", body), "facts"), "scroll")


def _older(run: Run) -> list[tuple[str, str]]:
    """Figures that are not of this run: it was one of some benchmarks only."""
    if not run.older:
        return []
    commits = ", ".join(dict.fromkeys(other.commit for other in run.older.values()))
    mine = len(run.results) - len(run.older)
    return [("Figures", f"{mine} benchmarks of this run, {len(run.older)} benchmarks from older runs: {commits}")]
