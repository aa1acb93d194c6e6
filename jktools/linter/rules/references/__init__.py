"""JK1xx: what names something that the level must hold."""
