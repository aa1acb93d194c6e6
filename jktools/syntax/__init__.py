"""Front ends: from the bytes of the game's files to frozen nodes with spans."""
