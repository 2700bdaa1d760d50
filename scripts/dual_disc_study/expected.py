"""Numbers to compare with. All errors are in parts of the magnitude."""
# Liu & Zhang, Table 3: time [s], largest error [%] at 5000, 25000 and 40000 rpm, step 5e-7 s, against their Newmark with 1e-7 s.
TABLE_3 = {"precise_1": ((136.784, 0.01840), (279.808, 0.00602), (717.165, 0.01838)),
           "precise_2": ((112.061, 0.01840), (227.980, 0.00602), (594.310, 0.01838)),
           "Newmark": ((88.670, 0.00033), (208.441, 0.00341), (542.589, 0.00632))}

# An implementation of its own, on matrices of its own, made for this project before simulate had the model: RMS error of disc 1, x, on t in
# [.08, .1] s at 5000 and 40000 rpm, and microseconds per step (one core, minimum of seven).
REFERENCE = {("Newmark", 5e-6): (7.8e-6, 2.5e-4, 0.84), ("Newmark", 1e-6): (3.2e-7, None, 14.6), ("precise_1", 1e-6): (1.3e-8, 2.6e-8, 9.0),
             ("precise_2", 1e-6): (1.3e-8, 2.6e-8, 5.4), ("HEERK3", 5e-6): (1.0e-8, 2.0e-8, 0.38), ("HEERK4", 1e-4): (5.3e-6, 2.2e-5, 0.53),
             ("HEERK4", 1e-5): (1.9e-9, 1.0e-8, 0.53), ("HEERK4, moved", 1e-4): (1.3e-7, 4.1e-6, 0.53)}
AS_PRINTED = (1.4e-6, 1.4e-5)  # Newmark, step 1e-6, tolerance 1e-6 as in the paper, at 5000 and 40000 rpm
AS_PRINTED_FINE = 1.6e-4       # the paper's reference: step 1e-7, tolerance 1e-6, at 5000 rpm

# The same source: disc 1 x, y and journal x, y [mm] at t = 0.1 s.
AT_END = {5000: (0.02785211732659, -0.01736736496295, 0.02211035471464, -0.0187719598338),
          40000: (-0.0112860983232, 0.001602334931393, 0.006018837854014, -0.002184867211825)}
CRITICALS = (4231.0, 10793.0, 76576.0)  # forward whirl [rpm]
