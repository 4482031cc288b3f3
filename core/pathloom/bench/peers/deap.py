"""DEAP: paths of any number of cells, evolved by operators in Python."""

import math
import random
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom.bench.peer import Answer, Peer, Solve, Until
from pathloom.bench.peers.grid_graph import length, octile, steps
from pathloom.bench.peers.way_points import GENERATIONS, POPULATION, sees
from pathloom.paths.problem import Cell, PathProblem

NOISE = 4.0
"""Cells by which a walk misjudges distances."""


class DeapPaths(Peer):
    """(μ + λ) with crossover at a common cell and mutation by walking anew; line of sight shortens the best."""

    name = "DEAP paths"
    distribution: ClassVar[str] = "deap"
    about = "lists of cells, varOr(0.6, 0.3), tournaments of 3, μ = λ = 100, 200 generations, the best shortened"

    def prepare(self, problem: PathProblem) -> Solve:
        from deap import algorithms, base, creator, tools

        around = steps(problem)
        start, goal = problem.ends
        if not hasattr(creator, "PathloomPath"):  # DEAP keeps its types in a module
            creator.create("PathloomLength", base.Fitness, weights=(-1.0,))
            creator.create("PathloomPath", list, fitness=creator.PathloomLength)

        def individual() -> Any:
            return creator.PathloomPath(walk(start, goal, around))

        def mate(one: Any, other: Any) -> tuple[Any, Any]:
            """Exchange the tails behind a random common cell."""
            place = {cell: k for k, cell in enumerate(other)}
            common = [i for i, cell in enumerate(one) if cell in place][1:-1]
            if common:
                i = random.choice(common)  # noqa: S311 - DEAP draws from it too
                j = place[one[i]]
                one[i:], other[j:] = other[j:], one[i:]
                one[:], other[:] = without_loops(one), without_loops(other)
            return one, other

        def mutate(path: Any) -> tuple[Any]:
            """Walk anew between two cells of the path."""
            if len(path) > 2:
                i, j = sorted(random.sample(range(len(path)), 2))
                path[i : j + 1] = walk(path[i], path[j], around)
                path[:] = without_loops(path)
            return (path,)

        toolbox = base.Toolbox()
        toolbox.register("population", tools.initRepeat, list, individual)
        toolbox.register("evaluate", lambda path: (length(path),))
        toolbox.register("mate", mate)
        toolbox.register("mutate", mutate)
        toolbox.register("select", tools.selTournament, tournsize=3)

        def evaluate(paths: list[Any]) -> None:
            for path in paths:
                if not path.fitness.valid:
                    path.fitness.values = toolbox.evaluate(path)

        def solve(seed: int, seconds: float = math.inf, target: float = 0.0) -> Answer:
            until = Until(seconds, target)
            random.seed(seed)
            if not problem.reachable:
                return None
            population = toolbox.population(n=POPULATION)
            best = tools.HallOfFame(1)
            evaluate(population)
            best.update(population)
            for _ in range(GENERATIONS):
                if until.over(_length(shortened(best[0], problem)) if target > 0.0 else math.inf):
                    break
                children = algorithms.varOr(population, toolbox, POPULATION, cxpb=0.6, mutpb=0.3)
                evaluate(children)
                best.update(children)
                population = toolbox.select(population + children, POPULATION)
            return shortened(best[0], problem)

        return solve


def walk(start: Cell, goal: Cell, around: dict[Cell, list[Cell]]) -> list[Cell]:
    """Return a path found depth first, towards the goal as far as that is judged rightly."""
    path, seen = [start], {start}
    while path[-1] != goal:
        fresh = [cell for cell in around[path[-1]] if cell not in seen]
        if not fresh:
            path.pop()
            continue
        path.append(min(fresh, key=lambda cell: _judged(cell, goal)))
        seen.add(path[-1])
    return path


def _judged(cell: Cell, goal: Cell) -> float:
    return octile(cell, goal) + NOISE * random.random()  # noqa: S311 - as above


def without_loops(path: list[Cell]) -> list[Cell]:
    """Return a path that visits no cell twice."""
    last = {cell: k for k, cell in enumerate(path)}
    kept, k = [], 0
    while k < len(path):
        kept.append(path[k])
        k = last[path[k]] + 1
    return kept


def shortened(path: list[Cell], problem: PathProblem) -> NDArray[np.int64]:
    """Return the path (k, 2) over the farthest cells that see each other."""
    cells = np.array(path, np.int64)
    kept, i = [0], 0
    while i < len(cells) - 1:
        j = len(cells) - 1
        while j > i + 1 and not sees(cells[i], cells[j], problem):
            j -= 1
        kept.append(j)
        i = j
    return cells[kept]


def _length(path: NDArray[np.int64]) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())
