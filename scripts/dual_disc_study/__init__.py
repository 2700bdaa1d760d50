"""The parts of scripts/paper_dual_disc.py."""
