"""The one error that a caller of jktools has to expect."""


class InputError(Exception):
    """A path that cannot be opened, or that is not what was asked for.

    The message is one sentence that names the path, what is wrong and, where there is one, the cure.
    """
