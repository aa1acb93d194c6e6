"""Rules on colour effects."""
