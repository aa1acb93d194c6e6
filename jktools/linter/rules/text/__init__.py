"""JK0xx: the text of a level."""
