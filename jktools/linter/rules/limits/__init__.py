"""JK8xx: limits of the engine."""
