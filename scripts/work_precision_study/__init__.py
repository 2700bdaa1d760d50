"""Error against CPU time: reading, comparing, drawing, telling."""
