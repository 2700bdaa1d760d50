"""Tables of the report. Each function returns Markdown."""
from lag_rotor_study.text import table

# (section, label, program, benchmark)
MACHINES = [
    ("lag rotor, K_s = 3·10⁴ N m/rad", "lag_rotor_step", "step/absolute_lag_3e4"),
    ("lag rotor, K_s = 3·10⁶", "lag_rotor_step", "step/absolute_lag_3e6"),
    ("lag rotor, K_s = 3·10⁸", "lag_rotor_step", "step/absolute_lag_3e8"),
    ("lag rotor, second-order hub terms", "lag_rotor_step", "step/absolute_lag_second_order"),
    ("lag rotor, the paper's form (Newton)", "lag_rotor_step", "step/printed_3e4"),
    ("lag rotor, the paper's form, HERK4", "lag_rotor_step", "step/printed_herk4"),
    ("lag rotor with swashplate", "lag_rotor_step", "step/controlled"),
    ("elastic rotor, 10 sections", "fe_rotor_step", "step/bo105"),
    ("elastic rotor, 20 sections", "fe_rotor_step", "step/bo105_20_sections"),
    ("elastic rotor, linear airloads", "fe_rotor_step", "step/bo105_linear_airloads"),
    ("elastic rotor, rigid mount", "fe_rotor_step", "step/bo105_rigid_mount"),
    ("elastic rotor, another rotor speed every revolution", "fe_rotor_step", "step/bo105_speed_changes"),
    ("dual disc, HEERK4, 5000 rpm", "dual_disc_step", "step/HEERK4"),
    ("dual disc, HEERK4, 40000 rpm", "dual_disc_step", "step/HEERK4_40000rpm"),
    ("dual disc, HEERK3", "dual_disc_step", "step/HEERK3"),
    ("dual disc, Newmark, modal", "dual_disc_step", "step/Newmark"),
    ("dual disc, Newmark, physical", "dual_disc_step", "step/Newmark_physical"),
    ("dual disc, precise_1, physical", "dual_disc_step", "step/precise_1_physical"),
    ("dual disc, precise_2, physical", "dual_disc_step", "step/precise_2_physical"),
    ("dual disc, precise_2, modal", "dual_disc_step", "step/precise_2_modal"),
]

# Groups of a step of the elastic rotor, as bench_fe_rotor_step measures them.
PARTS = [("structure_us", "structure (FE blades)"), ("airloads_us", "airloads"), ("other_models_us", "other models"), ("propagation_us", "propagation (φ functions of S)"),
         ("algebra_and_rest_us", "Newton, data, control")]

STARTUP = ["lag_rotor", "dual_disc", "bo105", "hart2"]
STARTUP_PARTS = [("reading_ms", "reading YAML"), ("system_ms", "coupled system (matrices, modes, tables)"), ("simulation_ms", "loops, matrix functions"), ("first_step_ms", "first step")]

OUTLETS = [
    ("step thread: reading, newest value, no ring", "recording", "handOn/{}/rings:0"),
    ("step thread: the same and 1 ring", "recording", "handOn/{}/rings:1"),
    ("step thread: the same and 3 rings", "recording", "handOn/{}/rings:3"),
    ("CSV, published signals", "recording", "csv/{}"),
    ("rosbag", "recording", "bag/{}"),
    ("LCM log", "recording", "lcmLog/{}"),
    ("LCM, UDP multicast", "recording", "lcmPublish/{}"),
]
PUBLISHING = [("ROS: filling state, lag angles, hub wrench", "fillMessages"), ("ROS: serialising the state", "serialise"), ("ROS: publish(), no subscriber", "publish/subscribers:0"),
              ("ROS: publish(), a subscriber by TCP", "publish/subscribers:1")]

# (claim, program, benchmark, largest time [s])
BOUNDS = [
    ("elastic rotor, 10 sections, at most 20 µs per step", "fe_rotor_step", "step/bo105", 20e-6),
    ("elastic rotor, 20 sections, at most 40 µs", "fe_rotor_step", "step/bo105_20_sections", 40e-6),
    ("lag rotor, K_s = 3·10⁴, at most 0.5 µs", "lag_rotor_step", "step/absolute_lag_3e4", 0.5e-6),
    ("lag rotor, K_s = 3·10⁸, at most 0.5 µs", "lag_rotor_step", "step/absolute_lag_3e8", 0.5e-6),
    ("start-up of the elastic rotor at most 100 ms", "startup", "toFirstStep/bo105", 0.1),
]


def time_text(seconds):
    """Three digits with the unit that suits."""
    for unit, scale in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= scale:
            return f"{seconds / scale:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def speed_change(results):
    """A sentence: what a change of the rotor speed does to single steps."""
    found = [results.get("fe_rotor_step", f"step/{name}") for name in ("bo105_speed_changes", "bo105")]
    if not all(found):
        return ""
    changing, steady = ([m.counters.get(f"wall_{which}_us", 0.0) for which in ("99.9%", "longest")] for m in found)
    return (f"When the speed command changes by 5 % every revolution, 99.9 % of the steps take at most {changing[0]:.0f} µs by the wall clock and the longest takes {changing[1]:.0f} µs "
            f"(at constant speed {steady[0]:.0f} and {steady[1]:.0f} µs) of {found[0].counters.get('h', 0.0) * 1e6:.0f} µs: nothing is tabulated anew, S belongs to the nominal speed.\n")


def generality(results):
    """The general coupled system beside steps written by hand for one problem each."""
    rows = []
    for label, name in (("lag rotor, K_s = 3·10⁴ N m/rad", "lag_rotor_3e4"), ("lag rotor, K_s = 3·10⁶", "lag_rotor_3e6"), ("lag rotor, K_s = 3·10⁸", "lag_rotor_3e8"),
                        ("dual disc, 5000 rpm", "dual_disc")):
        found = [results.get("hand_written", f"{kind}/{name}") for kind in ("general", "hand_written")]
        if all(found):
            rows.append([label, time_text(found[0].best), time_text(found[1].best), f"{found[0].best / found[1].best:.1f}", f"{found[1].counters.get('difference', 0.0):.0e}"])
    if not rows:
        return ""
    return """## Beside steps written by hand

What ports, loops and any number of models cost over a program for one problem alone, in the same run and with the same solution (`bench/hand_written_bench.cpp`):

""" + table(["machine", "general", "by hand", "ratio", "difference after 1000 steps"], rows) + """
The hand-written lag rotor knows that its blades are equal and undamped: it splits them into collective, differential and cyclic lag, takes the mast through all stages before the fuselage,
and all sines at once. Half of the general step is the same physics, with reaction and accelerations as two ports that share no work; the rest is calling (five
evaluations of models in each of five stages), propagation of two blocks by tables, and the check that every stage is finite. In the dual disc's step five film forces, each
waiting for the one before, take most of the hand-written time and a third of the general one.
"""


def machines(results):
    rows = []
    for label, program, name in MACHINES:
        m = results.get(program, name)
        if not m:
            rows.append([label] + ["-"] * 5)
            continue
        h = m.counters.get("h", 0.0)
        rows.append([label, time_text(m.best), time_text(m.median), time_text(h), f"{h / m.best:.3g}", f"{m.counters.get('residuals/solve', 0.0):.2f}"])
    return table(["machine", "step", "median", "stands for", "times real time", "residuals per solve"], rows)


def parts(results):
    header, columns = ["part"], []
    for label, name in (("10 sections", "parts/bo105"), ("20 sections", "parts/bo105_20_sections")):
        m = results.get("fe_rotor_step", name)
        if m:
            header.append(label)
            columns.append(m.counters)
    return table(header, [[label] + [f"{column[key]:.1f} µs" for column in columns] for key, label in PARTS]) if columns else ""


def startup(results):
    found = [(config, results.get("startup", f"toFirstStep/{config}")) for config in STARTUP]
    rows = [[f"`{config}.yaml`", time_text(m.best)] + [time_text(1e-3 * m.counters[key]) for key, _ in STARTUP_PARTS] for config, m in found if m]
    return table(["configuration", "YAML to first step"] + [label for _, label in STARTUP_PARTS], rows)


def outlets(results):
    rows = []
    for label, program, name in OUTLETS:
        found = [results.get(program, name.format(config)) for config in ("bo105", "dual_disc")]
        rows.append([label] + [time_text(m.best) if m else "-" for m in found])
    for label, name in PUBLISHING:
        m = results.get("publishing", name)
        rows.append([label, time_text(m.best) if m else "-", ""])
    return table(["per instant", "rotor (4 blades)", "shaft (2 discs)"], rows)


def aero(results):
    def per_item(program, name):
        m = results.get(program, name)
        return time_text(m.counters["time/item"]) if m else "-"

    rows = [[label] + [per_item("airfoil_table", f"{name}/lanes:{lanes}") for lanes in (1, 4, 8)]
            for label, name in (("lookup, bilinear", "airfoilLookup/linear"), ("lookup, monotone cubic", "airfoilLookup/cubic"), ("section, linear polar", "linearSection"),
                                ("section, bilinear table", "tableSection/linear"), ("section, bilinear, axis off the quarter chord", "tableSection/linear_offset_axis"),
                                ("section, cubic table", "tableSection/cubic"))]
    text = table(["per blade", "1 lane", "4 lanes", "8 lanes"], rows)
    rows = []
    for label, name in (("linear polar", "linearPolar"), ("bilinear table", "table/linear"), ("cubic table", "table/cubic"), ("table, Wagner lag, virtual mass", "unsteadyTable"),
                        ("two ports at inputs seen before", "bothPortsAgain")):
        found = [results.get("blade_airloads", f"{name}/blades:{blades}") for blades in (3, 4, 8)]
        rows.append([label] + [time_text(m.best) if m else "-" for m in found])
    return text + "\n" + table(["airloads of 10 sections, one evaluation", "3 blades", "4 blades", "8 blades"], rows)
