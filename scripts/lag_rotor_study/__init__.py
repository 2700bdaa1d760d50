"""Parts of paper_lag_rotor.py: runs of `simulate`, tables and figures of the HEERK paper's lag rotor study."""
