"""Sums up what gcov counted under src/: lines and branches of each folder on the terminal, of each file with its
uncovered lines in BUILD/report.txt. A line or branch counts as reached when it is in any object file, as kernels are
compiled several times. Forks between a call's return and its exception are left out; the
forks that a compiler adds for lists of data (the key tables of src/input) are not."""
import collections
import gzip
import json
import pathlib
import subprocess
import sys
import tempfile

build = pathlib.Path(sys.argv[1]).resolve()
source = build.parent.parent / "src"


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


def counts():
    """{file: ({line: count}, {(line, branch): count})}"""
    files = collections.defaultdict(lambda: (collections.Counter(), collections.Counter()))
    for document in counted_files():
        for entry in document["files"]:
            path = pathlib.Path(document["current_working_directory"], entry["file"]).resolve()
            if source not in path.parents:
                continue
            lines, branches = files[str(path.relative_to(source))]
            for line in entry["lines"]:
                number = line["line_number"]
                lines[number] += line["count"]
                for k, count in enumerate(forks(line["branches"])):
                    branches[number, k] += count
    return files


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


def main():
    files = counts()
    folders = collections.defaultdict(lambda: [0, 0, 0, 0])
    report = []
    for name, (lines, branches) in sorted(files.items()):
        sums = *reached(lines), *reached(branches)
        for total in (name.split("/")[0], "all"):
            folders[total] = [a + b for a, b in zip(folders[total], sums)]
        report.append(row(name, sums[:2], sums[2:]))
        missed = [number for number, count in lines.items() if count == 0]
        if missed:
            report.append("    never: " + ranges(missed))
    table = [row("src/" + name if name != "all" else name, sums[:2], sums[2:]) for name, sums in
             sorted(folders.items(), key=lambda item: (item[0] == "all", item[0]))]
    (build / "report.txt").write_text("\n".join(table + [""] + report) + "\n")
    print("\n".join(table))
    print(f"uncovered lines: {build / 'report.txt'}")


main()
