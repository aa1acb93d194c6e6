"""Text of files on a terminal."""


def printable(text: str) -> str:
    """A text that cannot steer a terminal: what is not printable as escapes."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
