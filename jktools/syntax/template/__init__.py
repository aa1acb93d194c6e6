"""Templates and things: their parameters as the engine reads them, and the template libraries of editors."""
