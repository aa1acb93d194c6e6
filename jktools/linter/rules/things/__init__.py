"""JK4xx: templates and things."""
