"""What the game does: pure functions over numpy arrays, one module a system, in two profiles."""
