"""Pictures of maps and paths: figures, animations, and the terminal's; matplotlib and such load when used."""

from pathloom.draw.animation import Frame, animate
from pathloom.draw.figure import path_figure
from pathloom.draw.live import Live
from pathloom.draw.saving import save
from pathloom.draw.terminal import picture

__all__ = ["Frame", "Live", "animate", "path_figure", "picture", "save"]
