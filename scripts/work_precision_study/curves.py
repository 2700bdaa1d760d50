"""Curves of error against CPU time, and times at equal error."""
import csv
import math
from dataclasses import dataclass, field

LEVELS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
OURS = ("HEERK4", "HEERK3", "HEERK2")                         # exponential methods of this project
LIBRARIES = ("CVODE BDF", "CVODE Adams", "ARKODE ERK", "ARKODE DIRK", "ARKODE IMEX", "IDA", "odeint dopri5")
OTHERS = ("HERK4", "Newmark", "precise_1", "precise_2", "generalized-alpha", "truncated RK4")
VARIANTS = ("truncated HEERK4",)                              # shown, counted on neither side


# Kinds of problem whose measured outputs are some of the published ones: these get a second comparison by all published outputs.
TWO_MEASURES = ("lag_rotor", "dual_disc")
ALL = "_all"                                                  # ends the name of the second comparison


@dataclass
class Point:
    parameter: float
    error: float
    seconds: float
    steps: int
    evaluations: int


@dataclass
class AtLevel:
    """Least CPU time for an error; `bound`: taken at a point that is more accurate still, because no larger step or tolerance was tried."""
    seconds: float
    setting: str
    bound: bool


@dataclass
class Problem:
    name: str
    reference: str = ""
    distance: float = math.nan
    curves: dict = field(default_factory=dict)                # (method, setting) -> [Point] in the order measured
    failed: dict = field(default_factory=dict)                # (method, setting) -> number of points without a result

    def methods(self):
        return [m for m in OURS + LIBRARIES + OTHERS + VARIANTS if any(key[0] == m for key in self.curves)]

    def settings(self, method):
        return [key[1] for key in self.curves if key[0] == method]

    def without_structure(self):
        """The same without settings that use a solver written for the structure of S: libraries as they come."""
        return Problem(self.name, curves={key: points for key, points in self.curves.items() if "structure" not in key[1]})

    def at(self, method, level):
        """AtLevel or None."""
        best = None
        for setting in self.settings(method):
            found = time_at(self.curves[method, setting], level)
            if found and (best is None or found[0] < best.seconds):
                best = AtLevel(found[0], setting, found[1])
        return best

    def fastest(self, methods, level):
        """(method, AtLevel) of the fastest of them, or None."""
        found = [(m, a) for m in methods if (a := self.at(m, level))]
        return min(found, key=lambda pair: pair[1].seconds) if found else None


def time_at(points, level):
    """(seconds, bound) for an error of at most `level`: straight lines in the log-log plot between neighbours of one curve, or a point itself."""
    best = None
    for k, p in enumerate(points):
        if p.error > level:
            continue
        before = points[k - 1] if k > 0 else None
        if before is not None and before.error > level and before.seconds < p.seconds:
            part = math.log(level / before.error) / math.log(p.error / before.error)
            found = before.seconds * (p.seconds / before.seconds) ** part, False
        else:
            found = p.seconds, k == 0 or before.error <= level
        if best is None or found[0] < best[0]:
            best = found
    return best


def read(file):
    """{name: Problem} in the order of the file; <name>_all follows <name> where there are two measures."""
    problems = {}
    with open(file, newline="", encoding="utf-8") as opened:
        for row in csv.DictReader(opened):
            for ending, column in (("", "error"), (ALL, "error_all")) if row["problem"].startswith(TWO_MEASURES) else (("", "error"),):
                name = row["problem"] + ending
                problem = problems.setdefault(name, Problem(name))
                key = row["method"], row["setting"]
                if row["method"] == "reference":
                    problem.reference, problem.distance = row["setting"], float(row[column])
                    continue
                points = problem.curves.setdefault(key, [])
                if row["status"] != "ok":
                    problem.failed[key] = problem.failed.get(key, 0) + 1
                    continue
                points.append(Point(float(row["h_or_tol"]), float(row[column]), float(row["cpu_s"]), int(row["steps"]), int(row["evaluations"])))
    for problem in problems.values():
        problem.curves = {key: points for key, points in problem.curves.items() if points}
    return problems
