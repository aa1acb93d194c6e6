"""What a script says and the engine reads otherwise, or not at all."""
