"""Tables of the report, as Markdown."""
from lag_rotor_study.text import table

# Table 5 of the paper: evaluations of g of the blades' model in one revolution, and their average per stage.
PAPER = {("HEERK2", 10): (71, 3.55), ("HEERK2", 1000): (7001, 3.5), ("HEERK2", 100000): (700027, 3.5), ("HEERK3", 10): (121, 4.0), ("HEERK3", 1000): (12001, 4.0),
         ("HEERK3", 100000): (1200029, 4.0), ("HEERK4", 10): (191, 3.8), ("HEERK4", 1000): (19056, 3.8), ("HEERK4", 100000): (1900075, 3.8)}
STEPS = (100, 360, 1000, 10000)


def table_5(study, checks):
    """Evaluations per step with the paper's tolerance rule, and per subsystem at 360 steps."""
    paper_rule = ["simulation.newton_tolerance=paper"]
    rows, largest = [], 0.0
    for method in ("HEERK2", "HEERK3", "HEERK4"):
        for steps in STEPS:
            counts = study.counts("tables, bilinear", method, steps, paper_rule)
            rotor, per_stage = counts["subsystems"]["rotor"], 1.0 / counts["stages"]
            loop = 1.0 + counts["newton_iterations"] * per_stage
            largest = max(largest, loop)
            paper = PAPER.get((method, steps))
            rows.append([method, steps, f"{counts['newton_iterations'] * per_stage:.2f}", f"{loop:.2f}", f"{rotor['output_ports'] * per_stage:.1f}",
                         f"{paper[1]}" if paper else ""])
    checks.add("with the paper's tolerance the loop of the blades' model is evaluated at most 4 times per stage", largest <= 4.0, f"{largest:.2f}")
    text = """## Table 5: evaluations of the algebraic part

Tolerance of the paper's rule, 0.001 min(1, (h/h_ref)^p). A stage evaluates the loop once more than it iterates. Ports of the blades' model outside the loop
(positions, velocities, section axes) are evaluated once per stage and not again in the loop; the paper counts calls of one g with everything.
The paper leaves open whether its counts include finite differences of the gradient; here they are included, but the gradient is kept for the whole run.

""" + table(["scheme", "steps per revolution", "Newton iterations per stage", "evaluations of the loop per stage", "output ports of the blades per stage",
              "paper: g of the blades per stage"], rows)
    counts = study.counts("tables, bilinear", "HEERK4", 360, [])
    rows = [[name, f"{row['f']:g}", f"{row['output_ports']:.1f}", row["ports"]] for name, row in counts["subsystems"].items()]
    return text + "\nPer step and subsystem, HEERK4, 360 steps, tolerance 10⁻¹⁰:\n\n" + table(["subsystem", "f", "g: output ports evaluated", "ports"], rows)
