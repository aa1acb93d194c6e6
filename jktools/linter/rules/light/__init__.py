"""Rules on light."""
