"""How much faster SUNDIALS runs when it is built with optimisation: the same integrations by two builds of the program."""
import csv
import io
import statistics
import subprocess

METHODS = ("CVODE BDF", "CVODE Adams", "ARKODE ERK", "ARKODE IMEX", "ARKODE DIRK", "IDA")
PROBLEMS = ("lag_rotor_3e6", "blades_1")


def points(program, problem):
    """{(method, setting, tolerance): seconds}"""
    command = [program, problem, "--quick", "--limit", "0.3", "--methods", ",".join(METHODS)]
    output = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, universal_newlines=True, check=True).stdout
    return {(row["method"], row["setting"], row["h_or_tol"]): float(row["cpu_s"]) for row in csv.DictReader(io.StringIO(output)) if row["status"] == "ok" and row["cpu_s"]}


def measure(program, other, folder):
    with open(folder / "sundials_builds.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["problem", "method", "setting", "points", "median_time_ratio"])
        for problem in PROBLEMS:
            ours, theirs = points(program, problem), points(other, problem)
            for method, setting in dict.fromkeys(key[:2] for key in ours):
                ratios = [theirs[key] / ours[key] for key in ours if key[:2] == (method, setting) and key in theirs]
                if ratios:
                    writer.writerow([problem, method, setting, len(ratios), f"{statistics.median(ratios):.2f}"])


def read(folder):
    file = folder / "sundials_builds.csv"
    if not file.is_file():
        return []
    with open(file, newline="", encoding="utf-8") as opened:
        return list(csv.DictReader(opened))
