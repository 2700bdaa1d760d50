"""Figures of the report. Each writes a PNG file and returns Markdown."""
import math

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from fe_rotor_study.runs import POLARS, REVOLUTION
from lag_rotor_study.text import number, table

STEPS = (100, 125, 150, 200, 250, 300, 360, 402, 500, 700, 1000, 1500, 2000, 3000, 5000, 7000, 10000)
METHODS = {"HEERK2": ("tab:blue", "o-", 2), "HEERK3": ("tab:green", "s-", 3), "HEERK4": ("tab:red", "D-", 4)}
LARGEST = 6.11e5  # largest eigenvalue of the blades [1/s]
HERK4_LIMIT = LARGEST * REVOLUTION / (2.0 * math.sqrt(2.0))  # steps per revolution; RK4 is stable on the imaginary axis up to 2 sqrt(2)


def slope(points, low, high):
    """Least-squares order of (steps, error) between two numbers of steps."""
    chosen = [(math.log(n), math.log(e)) for n, e in points if low <= n <= high and e]
    return -np.polyfit(*zip(*chosen), 1)[0]


def draw(axis, points, style, **more):
    known = [(n, e) for n, e in points if e is not None and e > 0.0]
    axis.loglog(*zip(*known), style, ms=4.5, lw=1.3, **more)


def finish(axis, title):
    axis.set(title=title, xlabel="steps per revolution", xlim=(80, 7e4), ylim=(1e-14, 1))
    axis.grid(alpha=0.3)
    axis.axvline(360, color="0.6", lw=0.8, ls=":")


HERK4_STEPS = (28000, 29000, 30000, 31000, 32000, 33000, 36000, 45000)


def study_herk4(study, checks):
    errors = [(n, study.error("linear", "HERK4", n)) for n in HERK4_STEPS]
    stable = min((n for n, e in errors if e is not None), default=math.inf)
    checks.add(f"HERK4 becomes stable within 5 % of 2√2/|λ|max ({HERK4_LIMIT:.0f} steps)", abs(stable / HERK4_LIMIT - 1.0) < 0.05, f"{stable} steps")
    text = ", ".join(f"{n}: {'unstable' if e is None else f'{e:.1e}'}" for n, e in errors)
    return (f"Classical half-explicit HERK4 at these steps per revolution: {text}. Its limit 2√2/|λ|max with |λ|max = {LARGEST:.3g} 1/s is {HERK4_LIMIT:.0f} steps, "
            "85 times the 360 of HEERK4; the paper says about 10⁵.")


def figure_5(study, folder, checks):
    figure, panels = plt.subplots(1, 3, figsize=(15, 5.6), sharey=True)
    orders = {}
    for axis, airloads in zip(panels, POLARS):
        for method, (colour, style, order) in METHODS.items():
            points = [(n, study.error(airloads, method, n)) for n in STEPS]
            draw(axis, points, style, color=colour, label=method)
            orders[airloads, method] = slope([p for p in points if p[1] and p[1] > 1e-12], 100, 10000), dict(points)
        if airloads == "linear":
            steps = np.array([300.0, 3000.0])
            for order, at in ((2, 1e-4), (3, 4e-7), (4, 8e-9)):
                axis.loglog(steps, at * (steps / steps[0]) ** -order, color="0.55", lw=0.9)
                axis.text(steps[1] * 1.08, at * 10.0 ** -order, f"order {order}", color="0.4", fontsize=8, va="center")
            herk = [(n, study.error(airloads, "HERK4", n)) for n in HERK4_STEPS]
            stable = [p for p in herk if p[1] is not None]
            if stable:
                draw(axis, stable, "^-", color="black", label="HERK4")
            axis.plot([n for n, e in herk if e is None], [0.3] * sum(e is None for _, e in herk), "x", color="black", label="HERK4 unstable")
            axis.axvline(HERK4_LIMIT, color="black", lw=0.9, ls="--")
            axis.text(HERK4_LIMIT * 0.93, 3e-7, r"HERK4: $2\sqrt{2}/|\lambda|$", rotation=90, ha="right", va="top", fontsize=8)
        finish(axis, airloads)
    panels[0].set_ylabel("weighted error after one revolution")
    panels[0].legend(loc="upper right", bbox_to_anchor=(0.83, 1.0), fontsize=8)
    panels[0].text(345, 2e-14, "one degree", color="0.4", fontsize=8, ha="right")
    figure.tight_layout()
    figure.savefig(folder / "figure_5.png", dpi=80)
    plt.close(figure)
    for method, (_, _, order) in METHODS.items():
        found = orders["linear", method][0]
        low = order - 0.3  # HEERK4 does not pass with a free fuselage: an open point, see the next section
        checks.add(f"{method}, linear airloads: order {order} between 100 and 10⁴ steps (errors above 10⁻¹²), at least {low:.1f}", low <= found <= order + 0.5, f"{found:.2f}")
    finest = min(e for e in orders["linear", "HEERK4"][1].values() if e)
    checks.add("HEERK4, linear airloads: error falls below 10⁻¹¹ (the paper's flattens at 10³ steps)", finest < 1e-11, f"{finest:.1e}")
    rows = [[n] + [number(orders[airloads, method][1][n]) for airloads in POLARS for method in METHODS] for n in STEPS]
    header = ["steps"] + [f"{method}, {airloads}" for airloads in POLARS for method in METHODS]
    found = "; ".join(f"{airloads}: " + ", ".join(f"{m} {orders[airloads, m][0]:.2f}" for m in METHODS) for airloads in POLARS)
    return f"""## Figure 5: error over steps per revolution

![Error over steps per revolution](figure_5.png)

Left the paper's Figure 5 a, right its Figure 5 b. Least-squares orders between 100 and 10⁴ steps (errors above 10⁻¹²): {found}. The kinks of bilinear
tables limit the order of HEERK3 and HEERK4; monotone cubic tables (continuous slope) behave like smooth airloads here, where nothing stalls. The paper's HEERK4 flattens at 10³ steps because of its
matrix exponentials; here modes are decoupled before the functions of S are taken (errors <= 10⁻¹³: test/integrate/linear_propagator_test.cpp,
phi_functions_test.cpp), and the order goes on until round-off. It is a little less than 4; why, the next section says.

""" + table(header, rows) + f"""
### HERK4

{study_herk4(study, checks)}
"""


FUSELAGE_HELD = ("subsystems.fuselage.mode=rigid",)  # the mast stays elastic


def hub_coupling(study, folder, checks):
    """Where order is lost: S describes blades on a hub that does not move."""
    steps = (100, 150, 220, 330, 500, 730, 1000, 1600)
    figure, axis = plt.subplots(figsize=(8, 5.6))
    curves = {}
    for name, style, more, sudden in (("smooth, fuselage free", "D-", (), False), ("smooth, fuselage held", "s--", FUSELAGE_HELD, False), ("suddenly loaded, fuselage free", "o-", (), True)):
        curves[name] = [(n, study.error("linear", "HEERK4", n, more, sudden)) for n in steps]
        draw(axis, curves[name], style, label=name)
    finish(axis, "HEERK4, linear airloads: where order is lost")
    axis.set(xlim=(80, 2e3), ylim=(1e-13, 1), ylabel="weighted error after one revolution")
    axis.legend(loc="center right", bbox_to_anchor=(1.0, 0.7))
    figure.tight_layout()
    figure.savefig(folder / "hub_coupling.png", dpi=80)
    plt.close(figure)
    orders = {name: slope(points, 100, 1600) for name, points in curves.items()}
    checks.add("HEERK4 with the fuselage held: order above 3.7, and more than with the fuselage free", orders["smooth, fuselage held"] > max(3.7, orders["smooth, fuselage free"]),
               f"{orders['smooth, fuselage held']:.2f} against {orders['smooth, fuselage free']:.2f}")
    return f"""## What costs order

![Error with fuselage free, fuselage held, and with a sudden start](hub_coupling.png)

Orders between 100 and 1600 steps: {", ".join(f"{name} {order:.2f}" for name, order in orders.items())}. S describes the blades on a hub that does not
move. The hub's acceleration is driven by the root forces, which contain the stiff omega² q, and acts back on the modes through f~: that part of the
stiffness is outside S, and f~ is not Lipschitz independently of the stiffness, as the theory of stiff orders assumes. Holding the fuselage (`fuselage.mode: rigid`)
restores order 4, although hub and elastic mast still turn freely; so does a fuselage of thousandfold inertia (3.99): it is the root moments, through roll and pitch; more structural damping does not (beta = 10⁻⁵: unchanged). The bumps of the curves above have the same cause: where h omega
is a multiple of 2 pi for a mode (17866 rad/s at 402 steps), e^(ih omega) = 1 and this feedback acts in resonance; the paper saw a bump near 100 steps.
A sudden load at t = 0 (run without `--trim` or `simulation.start`) lets modes ring that no practical step resolves (h omega >> 1, damping 10⁻⁴ and less at
mid frequencies): their phase is lost, and the error of the outputs stays at some percent for every step and method. Real-time runs should start trimmed.
"""
