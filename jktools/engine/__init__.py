"""What the game does: the rules of the engine, one module a system, in profiles."""
