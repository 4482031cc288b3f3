"""How fitness converges over several seeds."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from pathloom.draw.evolution.lines import columns, generations_figure
from pathloom.draw.study.sheet import Sheet

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def convergence_figure(
    runs: Mapping[str, Sequence[object]], *, column: str = "best", sheet: Sheet = Sheet()
) -> "Figure":
    """Draw the fitness of several runs over generations: the median, and a band from the 10th to the 90th percentile.

    Parameters
    ----------
    runs
        By name the histories of its runs, such as ``result.history`` or ``state.history``.
    column
        ``best``, ``generation_best`` or ``mean``.

    Raises
    ------
    PathloomError
        If there are no runs, or one has no such column.
    """
    return generations_figure(columns(runs, column), f"fitness, {column.replace('_', ' ')}", share=False, sheet=sheet)
