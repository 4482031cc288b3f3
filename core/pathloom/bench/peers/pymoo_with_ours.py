"""pymoo with our operators: IMGA's sampling, crossover, mutation and objectives as pymoo's.

A small adapter of the benchmark's own; the plugin `pymoo` is the one to use.
Individuals are rows of cell ids in an object array; each operator still gets
the whole batch at once.
"""

import math
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom.bench.peer import Answer, Peer, Solve, Until
from pathloom.bench.peers.way_points import POPULATION
from pathloom.kernel.compose import compose
from pathloom.kernel.evaluation import measure
from pathloom.kernel.representation import Population
from pathloom.paths.objectives import Length
from pathloom.paths.problem import PathProblem

GENERATIONS = 50
"""As many as IMGA has."""


def rows_of(population: Population) -> NDArray[np.object_]:
    """Return an object array (n, 1) of rows without their padding."""
    rows = np.empty((len(population), 1), object)
    rows[:, 0] = [row[row >= 0] for row in population]
    return rows


def population_of(rows: NDArray[np.object_]) -> Population:
    """Return the padded population (n, width) of an object array of rows."""
    flat = rows.ravel().tolist()
    lengths = np.fromiter(map(len, flat), np.intp, len(flat))
    population = np.full((len(flat), lengths.max()), -1, np.int32)
    population[np.arange(lengths.max()) < lengths[:, np.newaxis]] = np.concatenate(flat)
    return population


def imga(**slots: Any) -> Any:
    """Return IMGA, whose slots are known to be filled."""
    return compose("imga", **slots)


class PymooGaWithOurs(Peer):
    """`GA` of pymoo, its own selection and survival, with the operators and objectives of IMGA."""

    name = "pymoo GA, our operators"
    distribution: ClassVar[str] = "pymoo"
    about = "operators and weighted objectives of imga over perturbed trees in pymoo's GA, 100 × 50, answer refined"
    weighted: ClassVar[bool] = True

    def algorithm(self, **operators: Any) -> Any:
        """Return the algorithm."""
        from pymoo.algorithms.soo.nonconvex.ga import GA

        return GA(pop_size=POPULATION, **operators)

    def setup(self, problem: PathProblem, seed: int, sampling: str = "perturbed-trees", *, unique: bool = True) -> Any:
        """Return pymoo's algorithm, ready for its first generation.

        ``unique``: as usual in pymoo, pairs are crossed until there are as many
        children as are wanted, all of them new; ours does without.
        """
        from pymoo.core.crossover import Crossover
        from pymoo.core.duplicate import HashDuplicateElimination
        from pymoo.core.mutation import Mutation
        from pymoo.core.problem import Problem
        from pymoo.core.sampling import Sampling

        planner = imga(sampling=sampling)
        crossover, mutation = planner.crossover, planner.mutation
        rng = np.random.default_rng(seed)
        objectives = list(planner.objectives.objectives())
        weights = planner.weights(problem)
        count = 1 if self.weighted else len(objectives)

        class Paths(Problem):  # type: ignore[misc]
            def __init__(self) -> None:
                super().__init__(n_var=1, n_obj=count, vtype=object)

            def _evaluate(self, x: Any, out: dict[str, Any], *_: Any, **__: Any) -> None:
                values = measure(objectives, population_of(x), problem)
                out["F"] = values @ weights if count == 1 else values

        class Sampled(Sampling):  # type: ignore[misc]
            def _do(self, _: Any, n: int, *__: Any, **___: Any) -> Any:
                return rows_of(planner.sampling.sample(problem, n, rng))

        class Crossed(Crossover):  # type: ignore[misc]
            def _do(self, _: Any, x: Any, *__: Any, **___: Any) -> Any:
                pairs = np.arange(x.shape[1] * 2).reshape(2, -1).T
                children = crossover.cross(population_of(x.reshape(-1, 1)), pairs, problem, rng)
                return rows_of(children).reshape(x.shape)

        class Mutated(Mutation):  # type: ignore[misc]
            def _do(self, _: Any, x: Any, *__: Any, **___: Any) -> Any:
                return rows_of(mutation.apply(population_of(x), np.arange(len(x)), problem, rng))

        algorithm = self.algorithm(
            sampling=Sampled(),
            crossover=Crossed(2, 2, prob=crossover.rate),
            mutation=Mutated(prob=mutation.rate),
            eliminate_duplicates=HashDuplicateElimination(_identity) if unique else None,
        )
        algorithm.setup(Paths(), termination=("n_gen", GENERATIONS), seed=seed, verbose=False)
        return algorithm

    def prepare(self, problem: PathProblem) -> Solve:
        refinement = imga().refinement

        def shortest(algorithm: Any) -> tuple[float, Any]:
            """Refine what is best so far, and return the length and the row of the shortest."""
            best = algorithm.opt
            if best is None or len(best) == 0:
                return math.inf, None
            refined = refinement.apply(population_of(best.get("X")), problem, np.random.default_rng(0))
            lengths = Length().measure(refined, problem)
            return float(lengths.min()), refined[lengths.argmin()]

        def solve(seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
            until = Until(seconds, target)
            algorithm = self.setup(problem, seed)
            while algorithm.has_next():
                algorithm.next()
                if until.over(shortest(algorithm)[0] if target > 0.0 else math.inf):
                    break
            _, row = shortest(algorithm)
            return None if row is None else problem.representation.decode(row)

        return solve


class PymooNsga2WithOurs(PymooGaWithOurs):
    """`NSGA2` of pymoo with the operators of IMGA and its three objectives, each for itself."""

    name = "pymoo NSGA-II, our operators"
    about = "as pymoo GA with our operators, the three objectives each for itself; the shortest of the front, refined"
    weighted: ClassVar[bool] = False

    def algorithm(self, **operators: Any) -> Any:
        from pymoo.algorithms.moo.nsga2 import NSGA2

        return NSGA2(pop_size=POPULATION, **operators)


def _identity(individual: Any) -> Any:
    """Return what tells individuals apart; pymoo asks twice, the second time for its own answer."""
    return individual if isinstance(individual, bytes) else individual.X[0].tobytes()
