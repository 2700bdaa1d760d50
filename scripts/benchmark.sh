#!/usr/bin/env bash
# Installs what is missing, runs every benchmark program (Google Benchmark, JSON to build/benchmark) and writes docs/performance.md with tables and plots.
# usage: benchmark.sh [--quick] [--no-build] [--only NAME]... [--cpu N] [--output DIR]
#   --quick     shorter measurements, fewer repetitions: a look, not a record
#   --no-build  use the programs as they are, install nothing
#   --only      run only bench_NAME, or sweep (repeatable); the report keeps earlier results of the others
#   --cpu       run the programs on this processor; the throughput of a sweep is measured on all that the script may use, if there are two
#   --output    directory of performance.md (default: docs)
# For a record keep the machine quiet: scripts/benchmark.sh --cpu 1, four minutes.
# Exit status: 0; 1 a program failed or a benchmark reported an error (the report says which); that of the build when it fails.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

quick=no only=() output=$repository/docs compile=yes pin=()
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) sed -n '2,10s/^# \{0,1\}//p' "$0"; exit 0 ;;
    --quick) quick=yes ;;
    --no-build) compile=no ;;
    --only) only+=("${2:?--only needs a name}"); shift ;;
    --cpu) pin=(taskset -c "${2:?--cpu needs a number}"); shift ;;
    --output) output=${2:?--output needs a directory}; shift ;;
    *) echo "benchmark.sh: unknown option '$1', see --help" >&2; exit 2 ;;
  esac
  shift
done

if [ "$compile" = yes ]; then
  "$repository/scripts/install_dependencies.sh" test
  build_targets benchmarks simulate
fi
results=$build/benchmark
programs=$build/devel/lib/heerk_rotor
mkdir -p "$results"
minimum=0.1 repetitions=5
[ "$quick" = no ] || { minimum=0.02 repetitions=2; }

# Publishing needs a master; one of its own on a free port, so that no running system is disturbed. Without one that part is skipped.
use_loopback
if command -v rosmaster >/dev/null; then
  port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
  export ROS_MASTER_URI=http://127.0.0.1:$port
  rosmaster --core -p "$port" >"$results/rosmaster.log" 2>&1 &
  master=$!
  trap 'kill "$master" 2>/dev/null; wait "$master" 2>/dev/null || true' EXIT
fi
ensure_multicast_route

chosen() { [ ${#only[@]} -eq 0 ] || [[ " ${only[*]} " == *" $1 "* ]]; }
remember_commit() { git -C "$repository" describe --always --abbrev=10 --exclude '*' --dirty=' with changes' >"$results/$1.commit" 2>/dev/null || true; }

status=0
for program in "$programs"/bench_*; do
  name=${program##*/bench_}
  chosen "$name" || continue
  echo "bench_$name"
  remember_commit "$name"
  "${pin[@]}" "$program" --benchmark_out="$results/$name.json" --benchmark_out_format=json --benchmark_min_time=$minimum --benchmark_repetitions=$repetitions \
    --benchmark_report_aggregates_only=false >"$results/$name.log" 2>&1 || { echo "bench_$name failed, see $results/$name.log" >&2; status=1; }
done

# Throughput of a sweep: eight runs of the elastic rotor by one job, by two, and, to see what the machine gives, by two programs that share nothing and do
# every other of the runs each. In turn, so that all see the same machine; one line per repetition, of those that are complete.
all_runs=3e5:3e7:8:log even_runs=3e5,1.1182e6,4.1681e6,1.5537e7 odd_runs=5.792e5,2.1589e6,8.0473e6,3e7
run_sweep() { # VALUES JOBS NAME
  "$programs/simulate" "$repository/config/bo105.yaml" --sweep "subsystems.mast.stiffness=$1" --revolutions 10 --signals rotor.lag --output "$results/sweep_$3.csv" --jobs "$2" --json \
    2>/dev/null >"$results/sweep.$3"
}
run_halves() {
  run_sweep "$even_runs" 1 even & local even=$!
  run_sweep "$odd_runs" 1 odd && wait $even || { wait $even; return 1; }
}
if chosen sweep && [ "$(nproc)" -ge 2 ]; then
  echo sweep
  : >"$results/sweep.repetitions"
  for ((i = 0; i < 2 * repetitions - 1; ++i)); do
    if run_sweep "$all_runs" 1 one && run_sweep "$all_runs" 2 two && run_halves; then
      printf '{"one_job": %s, "two_jobs": %s, "halves": [%s, %s]}\n' "$(<"$results/sweep.one")" "$(<"$results/sweep.two")" "$(<"$results/sweep.even")" "$(<"$results/sweep.odd")" \
        >>"$results/sweep.repetitions"
      cmp "$results/sweep_one.csv" "$results/sweep_two.csv" || status=1
    else
      echo "the sweep failed" >&2
      status=1
    fi
  done
fi

/usr/bin/python3 "$repository/scripts/performance_report.py" --results "$results" --build "$build" --output "$output" || status=1
exit $status
