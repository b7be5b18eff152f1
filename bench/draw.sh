# Draws the page: sourced by bench/run and bench/study, after src/build.sh.
# cinch_draw STORE RUN: of a stored run, beside what bench/count, bench/study and bench/stability have found last. Of older
# runs it takes only benchmarks that the program still has.
cinch_draw() {
  local found=$cinch_root/build/bench
  "$cinch_root/build/release/bench/cinch_bench" --benchmark_list_tests=true |
    python3 "$cinch_root/bench/dashboard.py" "$2" --runs "$1/runs" --known /dev/stdin --history "$1/history.jsonl" \
      --instructions "$found/instructions.json" --study "$found/study.json" --stability "$found/stability.json" \
      --out "$1/dashboard.html"
}
