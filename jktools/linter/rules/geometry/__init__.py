"""JK3xx: what is flat, convex and inside."""
