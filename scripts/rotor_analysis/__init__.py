"""What analyze_bag.py is made of: reading a recording, harmonics, damping, plots."""
