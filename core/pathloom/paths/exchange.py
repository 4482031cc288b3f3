"""Exchange of tails at a cell that two paths have in common."""

import numpy as np

from pathloom import compiled
from pathloom.kernel.counting import count
from pathloom.kernel.operators import Indices
from pathloom.kernel.representation import Population
from pathloom.paths.problem import PathProblem


def exchange_tails(
    population: Population,
    pairs: Indices,
    problem: PathProblem,
    rng: np.random.Generator,
    *,
    loops: bool = False,
) -> Population:
    """Let each pair (k, 2) exchange what follows a random cell that both visit between start and goal.

    ``loops``: keep whatever a child then has between two visits of one cell.
    Pairs without a common cell stay as they are, and are counted.
    """
    it = problem.context
    children, failed = compiled.exchange.exchange_tails(
        population, np.ascontiguousarray(pairs), it.blocked.size, loops, rng.bit_generator.random_raw(4)
    )
    count("crossover without a common cell", failed)
    return children  # type: ignore[no-any-return]
