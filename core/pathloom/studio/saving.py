"""Taking a run out of the page: the config that repeats it on the command line."""

import numpy as np
import tomli_w

from pathloom.config import frozen
from pathloom.errors import PathloomError
from pathloom.grid.movingai import render_movingai
from pathloom.kernel.compose import compose
from pathloom.paths.maps import map_of
from pathloom.paths.problem import PathProblem
from pathloom.studio.scene import problem_of
from pathloom.studio.wire import Asked, Saved

MAP_FILE = "studio.map"


def saved(asked: Asked) -> Saved:
    """Return the complete config of a run as TOML, and the map where it has no name that stands for it.

    Raises
    ------
    PathloomError
        If the planner or the problem cannot be used.
    """
    planner = compose(asked.planner)
    problem = problem_of(asked.scene)
    if _stands_for(asked.scene.name, problem):
        return Saved(tomli_w.dumps(frozen(problem, asked.scene.name, planner, asked.seed, None)))
    table = frozen(problem, MAP_FILE, planner, asked.seed, None)
    return Saved(tomli_w.dumps(table), MAP_FILE, render_movingai(problem.grid).decode("ascii"))


def _stands_for(name: str, problem: PathProblem) -> bool:
    """Say whether a name alone gives the map of a problem."""
    if not name:
        return False
    try:
        named = map_of(name).grid(problem.corners)
    except PathloomError:
        return False
    return np.array_equal(named.occupied, problem.grid.occupied)
