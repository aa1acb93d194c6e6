"""What a script does that cannot be meant: to time, to the stack, to the objects that it is bound to."""
