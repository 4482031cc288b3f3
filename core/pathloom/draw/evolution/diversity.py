"""How alike the individuals of a population become."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from pathloom.draw.evolution.lines import columns, generations_figure
from pathloom.draw.study.sheet import Sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def diversity_figure(runs: Mapping[str, Sequence[object]], *, sheet: Sheet = Sheet()) -> "Figure":
    """Draw the share of distinct individuals over generations: median and band over the runs.

    Parameters
    ----------
    runs
        By name the histories of its runs, such as ``result.history`` or ``state.history``.

    Raises
    ------
    PathloomError
        If there are no runs, or one has no diversity.
    """
    return generations_figure(columns(runs, "diversity"), "distinct individuals", share=True, sheet=sheet)
