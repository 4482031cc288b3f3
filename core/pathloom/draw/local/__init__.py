"""Pictures of local planning: who takes what for what, what more examples are worth, and drives."""

from pathloom.draw.local.confusion import confusion_figure
from pathloom.draw.local.drive import Moment, drive_figure
from pathloom.draw.local.film import animate_drive

__all__ = ["Moment", "animate_drive", "confusion_figure", "drive_figure"]
