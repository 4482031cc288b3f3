"""PyGAD: its GA over the coordinates of way-points."""

import math
import warnings
from typing import Any, ClassVar

import numpy as np

from pathloom.bench.peer import Answer, Peer, Solve, Until
from pathloom.bench.peers.way_points import GENERATIONS, POPULATION, WayPoints
from pathloom.paths.problem import PathProblem


class PygadGa(Peer):
    """Integer genes, tournaments, uniform crossover, small random steps as mutation, two elites."""

    name = "PyGAD GA"
    distribution: ClassVar[str] = "pygad"
    about = "6 way-points as integer genes, fitness 1 / (length + penalty), 100 × 200"

    def prepare(self, problem: PathProblem) -> Solve:
        import pygad

        ways = WayPoints(problem)
        space = [{"low": 0, "high": int(high) + 1} for high in ways.high]
        reach = max(2, int(0.1 * ways.high.max()))

        def solve(seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
            until = Until(seconds, target)

            def fitness(_: Any, vector: Any, __: int) -> float:
                return 1.0 / (1e-9 + ways.cost(vector))

            def stop(ga: Any) -> str | None:
                best, *_ = ga.best_solution(pop_fitness=ga.last_generation_fitness)
                return "stop" if until.over(ways.length(best)) else None

            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                ga = pygad.GA(
                    num_generations=GENERATIONS,
                    num_parents_mating=POPULATION // 2,
                    initial_population=np.rint(ways.first(POPULATION, np.random.default_rng(seed))).astype(int),
                    fitness_func=fitness,
                    gene_type=int,
                    gene_space=space,
                    parent_selection_type="tournament",
                    keep_elitism=2,
                    crossover_type="uniform",
                    mutation_type="random",
                    mutation_probability=0.1,
                    mutation_by_replacement=False,
                    random_mutation_min_val=-reach,
                    random_mutation_max_val=reach + 1,
                    on_generation=stop,
                    random_seed=seed,
                    suppress_warnings=True,
                )
                ga.run()
                best, *_ = ga.best_solution()
            return ways.answer(best)

        return solve
