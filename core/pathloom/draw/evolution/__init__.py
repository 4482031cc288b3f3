"""Figures of an evolution: where a population is, how it converges, how alike it becomes, what its operators do.

They take what ``pathloom.iterate`` yields and what a result's ``history`` holds; nothing more is recorded while
a planner runs.
"""

from pathloom.draw.evolution.convergence import convergence_figure
from pathloom.draw.evolution.diversity import diversity_figure
from pathloom.draw.evolution.heat import crossings, heat_figure
from pathloom.draw.evolution.probabilities import probabilities_figure

__all__ = ["convergence_figure", "crossings", "diversity_figure", "heat_figure", "probabilities_figure"]
