"""A level to look at: one HTML file that needs nothing else."""

from jktools.emit.html.page import LevelPage, Link, index_page, level_page, link_to

__all__ = ["LevelPage", "Link", "index_page", "level_page", "link_to"]
