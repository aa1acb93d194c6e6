"""Rules on what a level costs in play."""
