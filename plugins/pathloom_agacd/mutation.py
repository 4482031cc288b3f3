"""Section 4.7: mutation of a single gene."""

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from pathloom import Collision, Indices, Mutation, PathProblem, Population, Problem, Share, compiled, count
from pathloom.paths.cell_paths import cells_of
from pathloom.paths.context import Cells
from pathloom.paths.pathwise import path_problem
from pathloom_agacd.collision import LinearTrial, count_refused, tests_of

NOWHERE = np.empty(0, np.int32)


@dataclass(frozen=True, kw_only=True)
class SingleGene(Mutation):
    """Put a random free cell in the place of a random interior node.

    The paper does not say which cell. A path that would collide stays as it is.
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.7"
    works_on: ClassVar[str] = "cells"
    breaks: ClassVar[frozenset[str]] = frozenset({"8-connected"})

    rate: Share = 0.3
    among: Literal["neighbours", "anywhere"] = "neighbours"
    """Which free cells: the 8 neighbours of the node, or all that can be reached."""
    collision: Collision | None = LinearTrial()
    """Test of the two new segments; empty: none, and ``drop-colliding`` is to remove the mutants that collide."""

    def apply(self, population: Population, chosen: Indices, problem: Problem, rng: np.random.Generator) -> Population:
        it = path_problem(problem)
        cells = it.context.reachable_cells if self.among == "anywhere" else NOWHERE
        state = rng.bit_generator.random_raw(4)
        tests, on = tests_of(self.collision, it.context), it.context
        if tests is None:
            assert self.collision is not None, "no test is one that the kernels know"
            return _replace_genes(population, chosen, cells, it, self.collision, state)
        mutants, failed, refused = compiled.trial.replace_genes(
            population, chosen, cells, on.blocked, on.rows, on.cols, *tests, state
        )
        count("mutation failed", failed)
        count_refused(refused)
        return np.asarray(mutants)


def _replace_genes(
    population: Population, chosen: Indices, cells: Cells, problem: PathProblem, collision: Collision,
    state: NDArray[Any],
) -> Population:  # fmt: skip
    """Do what the kernel of this name does, with a collision test that only Python can do."""
    it = problem.context
    places, drawn = compiled.trial.draw_genes(population, chosen, cells, it.blocked, it.rows, it.cols, state)
    on = np.flatnonzero(places >= 0)
    before, after = (cells_of(population[chosen[on], places[on] + side], it.cols) for side in (-1, 1))
    new = cells_of(drawn[on], it.cols)
    free = collision.segments_free(before, new, problem) & collision.segments_free(new, after, problem)
    places[on[~free]] = -1
    count("mutation failed", int((places < 0).sum()))
    return np.asarray(compiled.trial.put_genes(population, chosen, places, drawn, it.blocked.size))
