#!/usr/bin/python3
"""Error against CPU time of our methods beside SUNDIALS (CVODE, ARKODE, IDA), Boost.odeint, generalized-alpha, Newmark and truncated modes, on the same
problems in the same run of the program work_precision. Writes work_precision.csv, one PNG per problem and work_precision.md to the output directory.

  cmake --build build --target work_precision && scripts/work_precision.py          about 10 minutes
  scripts/work_precision.py --quick                                                 fewer points and settings
  scripts/work_precision.py --reuse                                                 only figures and tables, from the CSV file that is there

Exit status: 0 all targets met, 1 one was missed (the report says which and by how much), 2 the program cannot be used.
"""
import argparse
import pathlib
import subprocess
import sys
import time

from work_precision_study import builds, curves, figures, report

ROOT = pathlib.Path(__file__).resolve().parent.parent


def measure(options, folder):
    """Runs the program problem by problem."""
    command = [options.program, "--rounds", str(options.rounds), "--limit", str(options.limit)] + (["--quick"] if options.quick else [])
    order = subprocess.run([options.program, "--list"], stdout=subprocess.PIPE, universal_newlines=True, check=True).stdout.split()
    names, rows = options.problems or order, []
    for name in names:
        begin = time.monotonic()
        result = subprocess.run(command + [name], stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True, check=False)
        if result.returncode != 0:
            raise RuntimeError(f"exit status {result.returncode} of\n  {' '.join(command + [name])}\n{result.stderr}")
        lines = result.stdout.splitlines()
        rows += lines if not rows else lines[1:]
        print(result.stderr, end="", file=sys.stderr)
        print(f"{name}: {len(lines) - 1} points, {time.monotonic() - begin:.0f} s", flush=True)
    file = folder / "work_precision.csv"
    if options.problems and file.is_file():  # the others stay, in the order of the program
        kept = [row for row in file.read_text(encoding="utf-8").splitlines()[1:] if row.split(",")[0] not in names]
        rows = rows[:1] + sorted(kept + rows[1:], key=lambda row: order.index(row.split(",")[0]))
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=str(ROOT / "build/devel/lib/heerk_rotor/work_precision"), help="default: %(default)s")
    parser.add_argument("--output", default=str(ROOT / "docs/performance"), help="directory (default: %(default)s)")
    parser.add_argument("--problems", nargs="*", help="measure only these; what the CSV file has of others stays (default: all)")
    parser.add_argument("--rounds", type=int, default=3, help="measurements per point, of which the median counts (default: %(default)s)")
    parser.add_argument("--limit", type=float, default=0.3, help="see the program's --help [s] (default: %(default)s)")
    parser.add_argument("--quick", action="store_true", help="fewer points and settings")
    parser.add_argument("--reuse", action="store_true", help="run nothing")
    parser.add_argument("--compare-build", metavar="PROGRAM",
                        help="a work_precision linked with another build of SUNDIALS: measures the ratio of CPU times, into sundials_builds.csv")
    options = parser.parse_args()
    folder = pathlib.Path(options.output)
    folder.mkdir(parents=True, exist_ok=True)
    for program in [options.program] * (not options.reuse) + [options.compare_build] * bool(options.compare_build):
        if not pathlib.Path(program).is_file():
            print(f"work_precision: {program} does not exist; build the target work_precision", file=sys.stderr)
            return 2
    begin = time.monotonic()
    if options.compare_build:
        builds.measure(options.program, options.compare_build, folder)
    if not options.reuse:
        measure(options, folder)
    study = curves.read(folder / "work_precision.csv")
    images = figures.draw(study, folder)
    checks = report.checks(study, options.limit)
    (folder / "work_precision.md").write_text(report.text(study, images, checks, folder, ROOT, options.quick), encoding="utf-8")
    for claim, found, verdict in checks.rows:
        print(f"{verdict.strip('*'):6}  {claim}: {found}")
    print(f"{folder / 'work_precision.md'}: {time.monotonic() - begin:.0f} s, {checks.failed} of {len(checks.rows)} targets missed")
    return 1 if checks.failed else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (RuntimeError, OSError, subprocess.CalledProcessError) as error:
        print(f"work_precision: {error}", file=sys.stderr)
        sys.exit(2)
