"""How likely crossover and mutation are, generation by generation."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from pathloom.draw.evolution.lines import QUANTILES, generations_figure
from pathloom.draw.look import Floats
from pathloom.draw.study.series import Curve
from pathloom.draw.study.sheet import Sheet
from pathloom.errors import PathloomError
from pathloom.kernel.evolution import Evolution
from pathloom.kernel.planner import Planner
from pathloom.kernel.state import State

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def probabilities_figure(planner: Planner, states: Iterable[State], *, sheet: Sheet = Sheet()) -> "Figure":
    """Draw the probabilities of crossover and mutation over generations.

    They are computed again, from each state's fitness and progress, for all individuals of the main population: the
    line is their median, the band goes from the 10th to the 90th percentile. Those that selection then chooses are
    fitter, and a pair is crossed with the rate of its fitter parent.

    Parameters
    ----------
    planner
        The planner that went through the states.
    states
        As ``pathloom.iterate`` yields them.

    Raises
    ------
    PathloomError
        If the planner has neither crossover nor mutation, or there are no states.
    """
    operators = {"crossover": planner.crossover, "mutation": planner.mutation} if isinstance(planner, Evolution) else {}
    found: dict[str, list[Floats]] = {name: [] for name, operator in operators.items() if operator is not None}
    if not found:
        raise PathloomError(f"planner {planner.name!r} has neither crossover nor mutation: no probabilities to draw")
    generations = []
    for state in states:
        generations.append(state.generation)
        for name, quantiles in found.items():
            rates = operators[name].rates(state.fitness, planner.progress(state))  # type: ignore[union-attr]
            quantiles.append(np.quantile(rates, QUANTILES))
    if not generations:
        raise PathloomError("found no states to draw, allowed one or more")
    curves = {}
    for name, quantiles in found.items():
        low, middle, high = np.array(quantiles).T
        curves[name] = Curve(generations, middle, low, high)
    return generations_figure(curves, "probability", share=True, sheet=sheet)
