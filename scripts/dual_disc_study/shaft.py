"""The shaft written out a second time, in the paper's units (t, mm, s, N): shares nothing with the models of the package.

Its bearings are isotropic: with z = x + i y and its slope z' = theta_y - i theta_x, the 36 degrees of freedom are 18 complex ones,
M z'' + (alpha M - i omega P) z' + K z = F. Hermitian elements of Euler and Bernoulli with rotary inertia; P: polar inertia.
"""
import math

import numpy as np
import scipy.linalg

SEGMENTS = (26.0, 118.0, 69.0, 69.0, 69.0, 69.0, 118.0, 26.0)           # [mm]
DIAMETER, YOUNG, DENSITY = 33.0, 2.1e5, 7.85e-9                         # [mm, N/mm^2, t/mm^3]
DISCS = ((2, 0.018745, 96.6, 188.2), (6, 0.016098, 72.1, 139.9))        # node, mass [t], J_d, J_p [t mm^2]
BEARINGS = ((1, 1e6), (7, 5700.0))                                      # node, stiffness [N/mm]
MASS_DAMPING = 20.0                                                     # alpha [1/s]
RPM = math.pi / 30.0                                                    # [rad/s]


def matrices():
    """M, P, K, each (18 x 18): deflection and slope of each node."""
    size = 2 * (len(SEGMENTS) + 1)
    area, inertia = math.pi * DIAMETER ** 2 / 4, math.pi * DIAMETER ** 4 / 64
    M, P, K = np.zeros((size, size)), np.zeros((size, size)), np.zeros((size, size))
    for e, l in enumerate(SEGMENTS):
        at = slice(2 * e, 2 * e + 4)
        M[at, at] += DENSITY * area * l / 420 * np.array(
            [[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l], [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]])
        rotary = DENSITY * inertia / (30 * l) * np.array(
            [[36, 3 * l, -36, 3 * l], [3 * l, 4 * l * l, -3 * l, -l * l], [-36, -3 * l, 36, -3 * l], [3 * l, -l * l, -3 * l, 4 * l * l]])
        M[at, at] += rotary
        P[at, at] += 2 * rotary
        K[at, at] += YOUNG * inertia / l ** 3 * np.array(
            [[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l], [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]])
    for node, mass, diametral, polar in DISCS:
        M[2 * node, 2 * node] += mass
        M[2 * node + 1, 2 * node + 1] += diametral
        P[2 * node + 1, 2 * node + 1] += polar
    for node, stiffness in BEARINGS:
        K[2 * node, 2 * node] += stiffness
    return M, P, K


def whirl(omega, damping=MASS_DAMPING):
    """Natural frequencies at the speed omega [rad/s], positive for forward whirl, ascending in magnitude."""
    M, P, K = matrices()
    n = len(M)
    # Coordinates in which M is the unit matrix keep entries small.
    upper = np.linalg.inv(np.linalg.cholesky(M))
    M_K, M_P = upper @ K @ upper.T, upper @ P @ upper.T
    H = np.block([[np.zeros((n, n)), np.eye(n)], [-M_K, 1j * omega * M_P - damping * np.eye(n)]])
    return np.array(sorted(scipy.linalg.eigvals(H).imag, key=abs))


def criticals():
    """Speeds of forward whirl in step with the rotor [rad/s], ascending."""
    M, P, K = matrices()
    squares = scipy.linalg.eigvals(M - P, K).real  # 1/omega^2
    return np.sort(1.0 / np.sqrt(squares[squares > 1e-14]))
