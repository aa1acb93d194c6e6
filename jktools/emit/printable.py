"""Text of files on a terminal."""


def printable(text: str) -> str:
    """A text that cannot steer a terminal: what is not printable as escapes."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def printable_step(step: float) -> str:
    """A step of a grid, which is a power of two: `1/4096`."""
    return f"{step:g}" if step >= 1 else f"1/{1 / step:.0f}"
