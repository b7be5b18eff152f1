"""Sums up what gcov counted under src/: lines and branches of each folder on the terminal, of each file with its
uncovered lines in BUILD/report.txt. A line or branch counts as reached when it is in any object file, as kernels are
compiled several times. Forks between a call's return and its exception are left out; the
forks that a compiler adds for lists of data (the key tables of src/input) are not.

tests/not_covered.txt gives reasons, one a line: FILE | TEXT | REASON. It holds for the lines of src/FILE that contain
TEXT, or, where TEXT is "NAME()", for the whole function NAME: line numbers may change. With --all, lines without a
reason and reasons without a line are an error; a reason that begins with "by chance" may go unused."""
import collections
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile

build = pathlib.Path(sys.argv[1]).resolve()
whole_suite = "--all" in sys.argv
root = build.parent.parent
source = root / "src"


def counted_files():
    """The JSON documents of gcov, one for each object file that was compiled with counters."""
    notes = [str(path) for path in build.rglob("*.gcno")]
    with tempfile.TemporaryDirectory() as folder:
        for note in notes:
            subprocess.run(["gcov", "--branch-counts", "--branch-probabilities", "--json-format", note], cwd=folder,
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for path in pathlib.Path(folder).glob("*.gcov.json.gz"):
                yield json.loads(gzip.decompress(path.read_bytes()))
                path.unlink()


def forks(branches):
    """Counts of a line's branches without the pairs of which one is an exception."""
    thrown = {k | 1 for k, branch in enumerate(branches) if branch["throw"]}
    return [branch["count"] for k, branch in enumerate(branches) if k | 1 not in thrown]


class File:
    def __init__(self):
        self.lines, self.branches = collections.Counter(), collections.Counter()
        self.functions = {}  # name: (first line, last line)


def counts():
    """{name: File}"""
    files = collections.defaultdict(File)
    for document in counted_files():
        for entry in document["files"]:
            path = pathlib.Path(document["current_working_directory"], entry["file"]).resolve()
            if source not in path.parents:
                continue
            file = files[str(path.relative_to(source))]
            for function in entry["functions"]:
                name = re.sub(r"\[abi:\w+\]", "", function["demangled_name"])
                file.functions[name] = function["start_line"], function["end_line"]
            texts = path.read_text().splitlines()
            for line in entry["lines"]:
                number = line["line_number"]
                if not texts[number - 1].strip(" {}();,"):  # only exceptions stop here
                    continue
                file.lines[number] += line["count"]
                for k, count in enumerate(forks(line["branches"])):
                    file.branches[number, k] += count
    return files


class Reason:
    def __init__(self, text):
        self.file, self.text, self.why = (part.strip() for part in text.split("|", 2))
        self.found = self.needed = False

    def holds(self, name, number, text, functions):
        if name != self.file:
            return False
        if not self.text.endswith("()"):
            return self.text in text
        call = self.text[:-1]
        return any(first <= number <= last for function, (first, last) in functions.items()
                   if function.startswith(call) or re.search(r"[ :*&~]" + re.escape(call), function))


def reasons():
    texts = (root / "tests/not_covered.txt").read_text().splitlines()
    return [Reason(text) for text in texts if text and not text.startswith("#")]


def sort_out(name, file, given):
    """The lines never reached, without and with a reason; notes which reasons are there and needed."""
    texts = (source / name).read_text().splitlines()
    without, explained = [], []
    for number, count in file.lines.items():
        mine = [reason for reason in given if reason.holds(name, number, texts[number - 1], file.functions)]
        for reason in mine:
            reason.found = True
            reason.needed |= count == 0
        if count == 0:
            (explained if mine else without).append(number)
    return without, explained


def reached(counter):
    return sum(count > 0 for count in counter.values()), len(counter)


def percent(part, whole):
    return f"{100 * part / whole:5.1f} % of {whole:6d}" if whole else f"{'-':>15}"


def row(name, lines, branches):
    return f"{name:34} lines {percent(*lines)}   branches {percent(*branches)}"


def ranges(numbers):
    """1, 2, 3, 7 -> "1-3 7" """
    found = []
    for number in sorted(numbers):
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return " ".join(str(a) if a == b else f"{a}-{b}" for a, b in found)


def table(files):
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    for name, file in files.items():
        for total in (name.split("/")[0], "all"):
            sums = *reached(file.lines), *reached(file.branches)
            folders[total] = [a + b for a, b in zip(folders[total], sums)]
    return [row("src/" + name if name != "all" else name, sums[:2], sums[2:]) for name, sums in
            sorted(folders.items(), key=lambda item: (item[0] == "all", item[0]))]


def main():
    files, given = counts(), reasons()
    report, complaints = table(files) + [""], []
    print("\n".join(report[:-1]))
    for name, file in sorted(files.items()):
        without, explained = sort_out(name, file, given)
        report.append(row(name, reached(file.lines), reached(file.branches)))
        if explained:
            report.append("    never, for a reason: " + ranges(explained))
        if without:
            report.append("    never: " + ranges(without))
            complaints.append(f"src/{name}: never reached, and no reason given: {ranges(without)}")
    for reason in given:
        if not reason.found:
            complaints.append(f"tests/not_covered.txt: no such line: {reason.file} | {reason.text}")
        elif not reason.needed and not reason.why.startswith("by chance"):
            complaints.append(f"tests/not_covered.txt: reached by now: {reason.file} | {reason.text}")
    (build / "report.txt").write_text("\n".join(report) + "\n")
    if whole_suite:
        print("\n".join(complaints), end="\n" if complaints else "")
    print(f"uncovered lines: {build / 'report.txt'}")
    return 1 if whole_suite and complaints else 0


sys.exit(main())
