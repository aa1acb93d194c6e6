"""What the game does: pure functions, one module a system, each in the profiles of `profile.Engine`."""
