"""Newmark's method as we read the paper, on the shaft of shaft.py: unknown displacements, Newton's iteration from the last displacement, ended by a
correction below a tolerance in parts of the displacement. Accelerations are 4/h^2 times differences of displacements, so that what the
tolerance and round-off leave behind is divided by h^2. Units of the paper.
"""
import math

import numpy as np

from dual_disc_study.shaft import MASS_DAMPING, RPM, matrices

UNBALANCES = ((2, 2.6e-4), (6, 2.23e-4))                                             # node, [t mm]
CLEARANCE, LENGTH, RADIUS, VISCOSITY, ECCENTRICITY = 0.16, 11.0, 67.5, 2e-8, -0.2    # [mm, mm, mm, N s/mm^2, parts of the clearance along y]
FILM = VISCOSITY * RADIUS * LENGTH ** 3 / CLEARANCE ** 3                             # [N s/mm]
JOURNAL = 7
NODES = 9


def film_force(x, y, vx, vy):
    """Short bearing, half film."""
    speed = math.hypot(vx, vy)
    if speed == 0.0:
        return 0.0, 0.0
    ux, uy = vx / speed, vy / speed
    x, y = x / CLEARANCE, y / CLEARANCE + ECCENTRICITY
    a, b = x * ux + y * uy, y * ux - x * uy
    D = 1.0 - a * a - b * b
    S, square, power = math.atan2(math.sqrt(D), -a), D * D, D * D * math.sqrt(D)
    along = 3.0 * a / square + S * (1.0 - b * b + 2.0 * a * a) / power
    across = b * (2.0 + a * a / (1.0 - b * b)) / square + 3.0 * a * b * S / power
    return -FILM * speed * (along * ux - across * uy), -FILM * speed * (along * uy + across * ux)


def run(speed, h, tolerance, duration, grid, form="residual"):
    """Rows of t [s] and of x, y of all nodes [mm] at multiples of `grid`, as (instants x 19); None when an iteration does not end.

    The corrections of the linear part come from its residual, or from matrices that were multiplied in advance: equal but for round-off."""
    omega = speed * RPM
    plane_mass, polar, plane_stiffness = matrices()
    n = len(plane_mass)  # rows 0 .. n-1: plane of x, n .. 2n-1: plane of y
    M, K = np.kron(np.eye(2), plane_mass), np.kron(np.eye(2), plane_stiffness)
    C = MASS_DAMPING * M + omega * np.block([[np.zeros((n, n)), polar], [-polar, np.zeros((n, n))]])
    unbalance = np.zeros((2 * n, 2))
    for node, value in UNBALANCES:
        unbalance[2 * node, 0] = unbalance[n + 2 * node, 1] = value * omega ** 2
    rate = 2.0 / h
    effective = K + rate * C + 4.0 / h ** 2 * M
    inverse = np.linalg.inv(effective)
    jx, jy = 2 * JOURNAL, n + 2 * JOURNAL
    force = inverse[:, [jx, jy]]
    from_x, from_v, from_a = inverse @ (4.0 / h ** 2 * M + rate * C), inverse @ (4.0 / h * M + C), inverse @ M
    from_unbalance = inverse @ unbalance
    (w11, w12), (w21, w22) = force[[jx, jy]].tolist()
    x, v, a = np.zeros(2 * n), np.zeros(2 * n), np.linalg.solve(M, unbalance[:, 0])
    steps, every = round(duration / h), round(grid / h)
    rows = [np.zeros(1 + 2 * NODES)]
    small = 1e-9  # difference of the film's derivatives [mm]
    for k in range(1, steps + 1):
        c, s = math.cos(omega * k * h), math.sin(omega * k * h)
        if form == "residual":
            load = M @ (4.0 / h ** 2 * x + 4.0 / h * v + a) + C @ (rate * x + v) + c * unbalance[:, 0] + s * unbalance[:, 1]
        else:
            free = from_x @ x + from_v @ v + from_a @ a + c * from_unbalance[:, 0] + s * from_unbalance[:, 1]
        old_x, old_y, v_x, v_y = float(x[jx]), float(x[jy]), float(v[jx]), float(v[jy])
        new = x.copy()
        for _ in range(20):
            px, py = float(new[jx]), float(new[jy])
            vx, vy = rate * (px - old_x) - v_x, rate * (py - old_y) - v_y
            fx, fy = film_force(px, py, vx, vy)
            ax, ay = film_force(px + small, py, vx + rate * small, vy)
            bx, by = film_force(px, py + small, vx, vy + rate * small)
            ax, ay, bx, by = (ax - fx) / small, (ay - fy) / small, (bx - fx) / small, (by - fy) / small
            if form == "residual":
                residual = load - effective @ new
                residual[jx] += fx
                residual[jy] += fy
                step = inverse @ residual
            else:
                step = free - new + fx * force[:, 0] + fy * force[:, 1]
            # (effective - film's derivatives)^-1 residual; the film acts in two rows only.
            rx, ry = float(step[jx]), float(step[jy])
            j11, j12, j21, j22 = 1.0 - w11 * ax - w12 * ay, -w11 * bx - w12 * by, -w21 * ax - w22 * ay, 1.0 - w21 * bx - w22 * by
            det = j11 * j22 - j12 * j21
            dx, dy = (j22 * rx - j12 * ry) / det, (j11 * ry - j21 * rx) / det
            step += (ax * dx + bx * dy) * force[:, 0] + (ay * dx + by * dy) * force[:, 1]
            new += step
            if step @ step <= tolerance ** 2 * (new @ new):
                break
        else:
            return None
        difference = new - x
        a = 4.0 / h ** 2 * difference - 4.0 / h * v - a
        v = rate * difference - v
        x = new
        if k % every == 0:
            rows.append(np.concatenate([[k * h], np.column_stack([x[:n:2], x[n::2]]).ravel()]))
    return np.array(rows)
