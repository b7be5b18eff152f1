#!/usr/bin/env python3
"""Says what a run was made on and of: one key=value a line, for --benchmark_context of Google Benchmark.

    bench/machine.py --build build/release --mode quick [--machine NAME]

Times mean nothing without it: the dashboard keeps machines apart by it, bench/compare warns by it.
"""
from __future__ import annotations

import os
import platform
import re
import subprocess
from pathlib import Path

from command_line import Parser, run_main

ROOT = Path(__file__).resolve().parent.parent

# What src/kernels/kernel_table.cpp asks the processor for.
V3_FLAGS = {"avx2", "fma"}
V4_FLAGS = V3_FLAGS | {"avx512f", "avx512vl", "avx512dq", "avx512bw"}


def cpu_info(key: str) -> str:
    """A line of /proc/cpuinfo, of the first processor."""
    try:
        found = re.search(rf"^{key}\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    except OSError:
        found = None
    return found[1].strip() if found else ""


def cpu() -> str:
    """The processor's name, or its architecture where it has none."""
    return cpu_info("model name") or platform.machine()


def isa(flags: set[str], native: bool, wanted: str | None) -> str:
    """The instruction set that the kernels take: the highest that processor, build and CINCH_ISA allow."""
    if wanted:
        return wanted
    if native and V4_FLAGS <= flags:
        return "v4"
    return "v3" if native and V3_FLAGS <= flags else "base"


def cache_value(build: Path, key: str) -> str:
    """A variable of CMake's cache."""
    return _line_of(build / "CMakeCache.txt", rf"^{key}:\w+=(.*)$")


def compiler(build: Path) -> str:
    """Compiler and version as CMake has found them."""
    for file in sorted(build.glob("CMakeFiles/*/CMakeCXXCompiler.cmake")):
        name = _line_of(file, r'^set\(CMAKE_CXX_COMPILER_ID "(.*)"\)$')
        version = _line_of(file, r'^set\(CMAKE_CXX_COMPILER_VERSION "(.*)"\)$')
        return f"{name} {version}"
    return ""


def _line_of(file: Path, pattern: str) -> str:
    try:
        found = re.search(pattern, file.read_text(encoding="utf-8"), re.MULTILINE)
    except OSError:
        found = None
    return found[1] if found else ""


def git(*arguments: str) -> str:
    """What git says about the sources, or nothing where they lie in no repository."""
    try:
        done = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.strip()


def context(build: Path, mode: str, machine: str) -> dict[str, str]:
    """Everything that a stored run says about itself; what cannot be found out stays empty."""
    commit = git("rev-parse", "--short=12", "HEAD")
    native = cache_value(build, "CINCH_NATIVE_ISAS") == "ON" and platform.machine() == "x86_64"
    return {
        "machine": machine,
        "cpu": cpu(),
        "cores": str(len(os.sched_getaffinity(0))),
        "isa": isa(set(cpu_info("flags").split()), native, os.environ.get("CINCH_ISA")),
        "compiler": compiler(build),
        "build_type": cache_value(build, "CMAKE_BUILD_TYPE"),
        "commit": commit,
        "commit_date": git("show", "-s", "--format=%cI", "HEAD"),
        "dirty": commit and ("yes" if git("status", "--porcelain", "-uno") else "no"),
        "mode": mode,
    }


def main() -> int:
    parser = Parser(prog="bench/machine.py", description="Says what a run is made on and of.")
    parser.add_argument("--build", type=Path, required=True, help="build folder")
    parser.add_argument("--mode", required=True, help="quick or full")
    parser.add_argument("--machine", default=platform.node(), help="the machine's name (default: its host name)")
    given = parser.parse_args()
    for key, value in context(given.build, given.mode, given.machine).items():
        if value:
            print(f"{key}={re.sub('[,=]', ';', value)}")  # Google Benchmark splits at both signs
    return 0


if __name__ == "__main__":
    run_main(main)
