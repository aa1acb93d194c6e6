"""JK9xx: jktools itself."""
