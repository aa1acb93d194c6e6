"""Rules on clouds of particles."""
