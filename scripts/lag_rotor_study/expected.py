"""Numbers to compare with: those the paper prints, and those that have to come out."""

PAPER_TABLE_1 = {("HERK4", 1e-2): 1.5e-1, ("HERK4", 1e-3): 1.4e-4, ("HERK4", 1e-4): 1.4e-8,
                 ("HEERK4", 1e-2): 1.2e-1, ("HEERK4", 1e-3): 7.3e-6, ("HEERK4", 1e-4): 7.2e-10}
PAPER_TABLE_2 = {  # run time [s] for K_s = 3e4, 3e5, 3e6, each HERK4 and HEERK4; None: n.c.
    1e-1: (None, None, None, None, None, None), 1e-2: (0.7, 1.0, None, 0.9, None, None),
    1e-3: (7.4, 9.8, 7.5, 9.7, 7.4, 10.8), 1e-4: (70.0, 93.7, 67.1, 93.0, 74.0, 104.0)}
PAPER_TABLE_3 = {3e4: (3.91, 114), 3e5: (12.35, 326), 3e6: (39.06, 1021), 3e8: (390.61, 10199)}

# What has to come out, from an implementation that shares no code with this package. Its norm has j = 0 in the denominator,
# which makes errors up to 0.2 % smaller at h = 0.01 s and 2 % at h = 0.1 s; printed digits and round-off add to that.
TABLE_1 = {("HERK4", 1e-2): 6.548e-2, ("HERK4", 1e-3): 6.202e-5, ("HERK4", 1e-4): 6.203e-9,
           ("HEERK4", 1e-2): 5.099e-2, ("HEERK4", 1e-3): 3.103e-6, ("HEERK4", 1e-4): 3.077e-10}
EIGENVALUE = {3e4: 113.91, 3e5: 326.49, 3e6: 1021.18, 3e7: 3225.67, 3e8: 10199.32}
LAG_AT_END = {3e4: 5.652580697331982e-4, 3e5: 2.676074313534727e-3,   # phi_1(10 s) [rad], quadruple precision
               3e6: 2.536578401834366e-3, 3e7: 2.512391606873492e-3}
CHI = {  # error at h = 0.1 s, at one degree; None: n.c.
    ("HERK4", "printed"): {3e4: (None, 3.0e-3), 3e6: (None, 6.8e-4), 3e8: (None, None)},
    ("HEERK4", "printed"): {3e4: (None, 1.5e-4), 3e6: (None, 7.0e-4), 3e8: (None, None)},
    ("HEERK4", "absolute_lag"): {3e4: (8.2e-3, 7.6e-8), 3e6: (2.3e-4, 4.2e-6), 3e8: (2.3e-4, 9.6e-7)},
    ("HEERK4", "exact0"): {3e4: (1.4e-1, 3.7e-5), 3e6: (9.7e-4, 2.2e-4), 3e8: (7.9e-5, 4.8e-6)}}
