"""Results of the benchmark programs, from the JSON files of Google Benchmark."""
import datetime
import json
import pathlib
import re
import statistics
import subprocess

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


class Measurement:
    """One benchmark: times per iteration of all repetitions [s], and the counters of the one that was fastest as a whole."""

    def __init__(self, name):
        self.name, self.times, self.counters, self.error = name, [], {}, None
        self.stretch = float("inf")  # shortest part of a repetition, where the program looks at the clock more often

    def add(self, entry):
        if entry.get("error_occurred"):
            self.error = entry.get("error_message", "unknown error")
            return
        # A benchmark with manual time measures what it means to; everything else is CPU time of the measuring thread.
        time = entry["real_time" if "/manual_time" in entry["name"] else "cpu_time"] * SECONDS[entry["time_unit"]]
        if not self.times or time < min(self.times):
            known = {"name", "run_name", "run_type", "repetitions", "repetition_index", "threads", "iterations", "real_time", "cpu_time", "time_unit", "family_index",
                     "per_family_instance_index", "error_occurred", "error_message", "label", "shortest_us"}
            self.counters = {key: value for key, value in entry.items() if key not in known}
        self.times.append(time)
        self.stretch = min(self.stretch, entry.get("shortest_us", float("inf")) * 1e-6)

    @property
    def best(self):
        """What other work on the machine adds is not the program's: the shortest repetition, or stretch of one."""
        return min(self.stretch, *self.times)

    @property
    def median(self):
        return statistics.median(self.times)


class Sweep:
    """A sweep by one job, by two, and by two programs that do half of it each; wall and CPU times [s], one entry per complete repetition."""

    def __init__(self, file):
        runs = [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []
        self.one, self.two = ([(run[jobs]["wall_time"], run[jobs]["cpu_time"]) for run in runs] for jobs in ("one_job", "two_jobs"))
        self.programs = [max(half["wall_time"] for half in run["halves"]) for run in runs]

    @staticmethod
    def median(times):
        """Median wall time and median CPU time."""
        return tuple(statistics.median(values) for values in zip(*times))

    def throughput(self):
        """Of two jobs, in parts of that of one: median over the repetitions."""
        return statistics.median(one[0] / two[0] for one, two in zip(self.one, self.two))

    def throughput_of_programs(self):
        """The same of the two programs."""
        return statistics.median(one[0] / both for one, both in zip(self.one, self.programs))

    def __bool__(self):
        return bool(self.one)


class Results:
    """All measurements by program and benchmark name, without the parts of the name that only say how it was run."""

    def __init__(self, folder):
        self.sweep = Sweep(pathlib.Path(folder) / "sweep.repetitions")
        self.programs, self.contexts, self.commits, self.repetitions = {}, {}, set(), 0
        for file in sorted(pathlib.Path(folder).glob("*.json")):
            try:
                content = json.loads(file.read_text())
            except json.JSONDecodeError:  # a program that ended early
                self.programs[file.stem] = {}
                continue
            self.contexts[file.stem] = content["context"]
            commit = file.with_suffix(".commit")
            self.commits.add(commit.read_text().strip() if commit.exists() else "unknown")
            measurements = self.programs.setdefault(file.stem, {})
            for entry in content["benchmarks"]:
                if entry.get("run_type") != "iteration":
                    continue
                name = re.sub(r"/(iterations:\d+|manual_time|repeats:\d+)", "", entry["name"])
                measurements.setdefault(name, Measurement(name)).add(entry)
            self.repetitions = max([self.repetitions] + [len(m.times) for m in measurements.values()])

    def get(self, program, name):
        """The measurement, or None when it is missing or failed."""
        found = self.programs.get(program, {}).get(name)
        return found if found and found.times else None

    def series(self, program, name):
        """(size, measurement) of a benchmark with one argument, in order of size."""
        pattern = re.compile(re.escape(name) + r"/(?:\w+:)?(\d+)")
        found = [(int(match.group(1)), m) for key, m in self.programs.get(program, {}).items() if (match := pattern.fullmatch(key)) and m.times]
        return sorted(found, key=lambda pair: pair[0])

    def errors(self):
        lines = [f"bench_{program}: no results" for program, found in self.programs.items() if not found]
        return lines + [f"bench_{program} {m.name}: {m.error}" for program, found in self.programs.items() for m in found.values() if m.error]

    def loads(self):
        """Load averages over a minute, at the start of each program."""
        return [context["load_avg"][0] for context in self.contexts.values() if context.get("load_avg")]

    def date(self):
        stamps = sorted(context["date"][:10] for context in self.contexts.values())
        return " to ".join(sorted({stamps[0], stamps[-1]})) if stamps else datetime.date.today().isoformat()


def output(*command, folder=None):
    try:
        return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def machine():
    text = pathlib.Path("/proc/cpuinfo").read_text()
    model = re.search(r"model name\s*:\s*(.*)", text)
    clock = [float(value) for value in re.findall(r"cpu MHz\s*:\s*([\d.]+)", text)]
    flags = re.search(r"flags\s*:\s*(.*)", text)
    widest = "AVX-512" if flags and "avx512f" in flags.group(1) else "AVX2" if flags and "avx2" in flags.group(1) else "SSE"
    return f"{model.group(1) if model else 'unknown processor'}, {max(clock, default=0.0) / 1000.0:.1f} GHz, {len(clock)} processors, {widest}"


def compiler(build):
    """Version line and flags of the benchmark programs."""
    commands = json.loads((pathlib.Path(build) / "compile_commands.json").read_text())
    words = next((entry["command"].split() for entry in commands if entry["file"].endswith("/bench/lag_rotor_step_bench.cpp")), [])
    version = output(words[0], "--version").splitlines()[0] if words else "unknown compiler"
    return version, " ".join(word for word in words if re.match(r"-(O|march|m|f|std|DNDEBUG)", word))

