"""Motion as data: scripts in, simulated or recorded traces out, and fits of what a recording shows."""
