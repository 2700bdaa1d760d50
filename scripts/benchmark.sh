#!/usr/bin/env bash
# Installs what is missing, runs every benchmark program (Google Benchmark, JSON to build/benchmark) and writes docs/performance.md with tables and plots.
# usage: benchmark.sh [--quick] [--no-build] [--only NAME]... [--cpu N] [--output DIR]
#   --quick     shorter measurements, fewer repetitions: a look, not a record
#   --no-build  use the programs as they are, install nothing
#   --only      run only bench_NAME, or sweep (repeatable); the report keeps earlier results of the others
#   --cpu       run the programs on this processor; the throughput of a sweep is measured on all that the script may use, if there are two
#   --output    directory of performance.md (default: docs)
# For a record keep the machine quiet: scripts/benchmark.sh --cpu 1, three minutes.
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

# Throughput of a sweep: eight runs of the elastic rotor by one job, by two, and by two programs with half of the runs each, which share nothing but the
# machine: what two jobs can reach on it. In turn, so that all see the same machine.
key=subsystems.mast.stiffness
run_sweep() { "$programs/simulate" "$repository/config/bo105.yaml" --sweep "$key=$1" --revolutions 10 --signals rotor.lag --output "$results/$2.csv" --jobs "$3" --json 2>/dev/null; }
if chosen sweep && [ "$(nproc)" -ge 2 ]; then
  echo sweep
  : >"$results/sweep.jobs"
  : >"$results/sweep.halves"
  for ((i = 0; i < 2 * repetitions - 1; ++i)); do
    for jobs in 1 2; do
      run_sweep 3e5:3e7:8:log "sweep_$jobs" $jobs >>"$results/sweep.jobs" || { echo "the sweep failed" >&2; status=1; }
    done
    run_sweep 3e5:2.16e6:4:log sweep_lower 1 >"$results/sweep.lower" &
    lower=$!
    run_sweep 4.17e6:3e7:4:log sweep_upper 1 >"$results/sweep.upper" || status=1
    wait $lower || status=1
    cat "$results/sweep.lower" "$results/sweep.upper" >>"$results/sweep.halves"
    cmp "$results/sweep_1.csv" "$results/sweep_2.csv" || status=1
  done
fi

/usr/bin/python3 "$repository/scripts/performance_report.py" --results "$results" --build "$build" --output "$output" || status=1
exit $status
