"""The parts of scripts/paper_fe_rotor.py."""
