"""Level compiler and static analyser for Star Wars Jedi Knight and Mysteries of the Sith."""

__version__ = "0.1.0"
