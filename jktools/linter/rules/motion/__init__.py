"""Rules on how templates move."""
