"""Figures of a study: who ranks where, how soon targets are reached, how gaps are spread, what a factor does.

They take plain numbers and names, and return matplotlib figures, as wide as a
column of a paper. Variants keep colour, dash and marker from figure to figure as
long as they come in the same order.
"""

from pathloom.draw.study.bands import bands_figure
from pathloom.draw.study.critical_difference import critical_difference_figure
from pathloom.draw.study.main_effects import Effect, main_effects_figure
from pathloom.draw.study.series import SERIES, Curve
from pathloom.draw.study.shares import ecdf_figure, profile_figure
from pathloom.draw.study.sheet import COLUMN, Sheet
from pathloom.draw.study.spread import spread_figure

__all__ = [
    "COLUMN",
    "SERIES",
    "Curve",
    "Effect",
    "Sheet",
    "bands_figure",
    "critical_difference_figure",
    "ecdf_figure",
    "main_effects_figure",
    "profile_figure",
    "spread_figure",
]
