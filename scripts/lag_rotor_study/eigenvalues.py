"""The paper's matrices (A.2, corrected), written out a second time: shares nothing with the models of the package."""
import math

import numpy as np

from lag_rotor_study.runs import OMEGA


def hub_inertia():
    return 4 * (2.7 ** 2 * 31.9 + 259.0)  # J = 4 (a+b)^2 m_b + 4 I_zb [kg m^2]


def largest_eigenvalues(stiffness):
    """Moduli for S_2, for the monolithic matrix at t = 0 (paper, A.2), and for the absolute-lag form's block [rad/s]."""
    a, b, inertia, mass, fuselage = 0.2, 2.5, 259.0, 31.9, 2902.9
    r_m, r_b = mass * b / (fuselage + 4 * mass), mass * b / (mass * b * b + inertia)
    r_a2, r_sb, omega_s2 = a * r_b, (b * (a + b) * mass + inertia) / hub_inertia(), stiffness / hub_inertia()
    lag = np.array([0.01, 0.0, 0.0, 0.0])
    psi = np.arange(4) * np.pi / 2  # azimuths of the blades
    k = r_a2 * OMEGA ** 2 + 1.5 ** 2
    M, K = np.eye(7), np.diag([9.0, 9.0] + 4 * [k] + [omega_s2])
    M[0, 2:6], M[1, 2:6] = -r_m * np.sin(psi), r_m * np.cos(psi)
    M[2:6, 0], M[2:6, 1], M[2:6, 6] = -r_b * np.sin(psi), r_b * np.cos(psi), r_a2 + 1
    M[6, 2:6] = r_sb
    M[0, 6], M[1, 6] = -r_m * np.sum(lag * np.cos(psi)), -r_m * np.sum(lag * np.sin(psi))
    A = np.block([[np.zeros((7, 7)), np.eye(7)], [-np.linalg.solve(M, K), np.zeros((7, 7))]])
    q = 4 * r_sb * (1 + r_a2)
    return math.sqrt(omega_s2), np.abs(np.linalg.eigvals(A)).max(), math.sqrt((omega_s2 + q * k) / (1 - q))
