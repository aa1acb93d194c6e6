"""JK701 to JK719: where bodies walk, fall, and cannot get out."""
