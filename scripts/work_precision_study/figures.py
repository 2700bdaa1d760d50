"""One figure per problem."""
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt

from work_precision_study.curves import ALL

STYLES = {"HEERK4": ("tab:red", "D-", 2.4), "HEERK3": ("tab:orange", "s-", 1.6), "HEERK2": ("goldenrod", "^-", 1.6), "HERK4": ("tab:gray", "v--", 1.2),
          "Newmark": ("tab:blue", "o-", 1.2), "generalized-alpha": ("deepskyblue", "o--", 1.2), "precise_1": ("tab:olive", "P--", 1.2),
          "precise_2": ("darkkhaki", "P-", 1.2),
          "truncated RK4": ("black", "x:", 1.2), "truncated HEERK4": ("tab:pink", "x:", 1.2), "CVODE BDF": ("tab:green", "s--", 1.2),
          "CVODE Adams": ("limegreen", "^--", 1.2),
          "ARKODE ERK": ("tab:brown", "v-", 1.2), "ARKODE DIRK": ("peru", ">-", 1.2), "ARKODE IMEX": ("tab:purple", "p-", 1.6), "IDA": ("teal", "*--", 1.2),
          "odeint dopri5": ("tab:cyan", "<-", 1.2)}
TITLES = {"lag_rotor_3e4": "lag rotor, K_s = 3e4 N m/rad", "lag_rotor_3e6": "lag rotor, K_s = 3e6 N m/rad", "lag_rotor_3e8": "lag rotor, K_s = 3e8 N m/rad",
          "blades_1": "one elastic blade on a turning hub", "blades_4": "four elastic blades on a turning hub", "rotor": "complete elastic rotor",
          "dual_disc_5000": "dual-disc rotor, 5000 rpm", "dual_disc_40000": "dual-disc rotor, 40000 rpm"}


MEASURES = {"lag_rotor": "lag angles", "dual_disc": "displacements of the discs"}


def title(name):
    """In words, with what the error is of where that is not all published outputs anyway."""
    base = name[:-len(ALL)] if name.endswith(ALL) else name
    words = TITLES.get(base, base)
    for kind, measure in MEASURES.items():
        if name.startswith(kind):
            words += ": all published outputs" if name.endswith(ALL) else f": {measure}"
    return words


def envelope(problem, method):
    """Points of all settings of a method that no other point of it beats in both error and time, fastest first."""
    points = sorted((p for s in problem.settings(method) for p in problem.curves[method, s]), key=lambda p: (p.seconds, p.error))
    best, kept = float("inf"), []
    for p in points:
        if p.error < best:
            best = p.error
            kept.append(p)
    return kept


def label_of(problem, method):
    settings = problem.settings(method)
    if method.startswith("truncated"):
        return f"{method} (best number of modes)"
    return f"{method} (best of settings)" if len(settings) > 1 else method


def draw(study, folder):
    """{problem: file name}; both measures of a problem share a figure."""
    files = {}
    for name in study:
        if name.endswith(ALL):
            continue
        parts = [study[key] for key in (name, name + ALL) if key in study]
        figure, axes = plt.subplots(1, len(parts), figsize=(10.5 if len(parts) == 1 else 15.5, 6.4), squeeze=False)
        for axis, problem in zip(axes[0], parts):
            panel(axis, problem)
        entries = {label: handle for axis in axes[0] for handle, label in zip(*axis.get_legend_handles_labels())}
        axes[0, -1].legend(entries.values(), entries.keys(), fontsize=8.5, loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False)
        figure.tight_layout()
        files[name] = f"work_precision_{name}.png"
        figure.savefig(folder / files[name], dpi=80)
        plt.close(figure)
    return files


def panel(axis, problem):
    for method in problem.methods():
        colour, style, width = STYLES[method]
        points = envelope(problem, method)
        axis.loglog([1e3 * p.seconds for p in points], [p.error for p in points], style, color=colour, lw=width, ms=5 if width < 2 else 6, label=label_of(problem, method),
                    zorder=3 if method == "HEERK4" else 2)
    axis.set(xlabel="CPU time of the integration [ms]", ylabel="error (RMS, relative)", title=title(problem.name), ylim=(1e-7, 1.0))
    axis.grid(alpha=0.3, which="major")
