"""The COG front end: from a script's text to a tree with spans."""
