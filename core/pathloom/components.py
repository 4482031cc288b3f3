"""The components that belong to no paper, registered through the same hook as everybody's."""

from pathloom.kernel.archive import BestRefined
from pathloom.kernel.evaluation import ReciprocalOfSum
from pathloom.kernel.evolution import Evolution, Generational
from pathloom.kernel.plugins import Add, hookimpl
from pathloom.kernel.selection import ConsecutivePairs, RandomPairs, Roulette, Tournament
from pathloom.kernel.survival import BestOfBoth, KeepBest, Replacement
from pathloom.kernel.termination import MaxEvaluations, MaxGenerations, Stagnation, TargetFitness, WallTime
from pathloom.paths.collision import Exact
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.objectives import Clearance, Length, TurnAngle, Turns, UnsafeCells
from pathloom.paths.tree_seeding import PerturbedTrees


@hookimpl
def register(add: Add) -> None:
    """Add what needs no prefix."""
    for component in (
        Evolution, Generational, BestRefined,
        PerturbedTrees,
        Length, UnsafeCells, Turns, TurnAngle, Clearance,
        ReciprocalOfSum,
        Roulette, Tournament, RandomPairs, ConsecutivePairs,
        Replacement, KeepBest, BestOfBoth,
        PointDeletion, Exact,
        MaxGenerations, MaxEvaluations, Stagnation, TargetFitness, WallTime,
    ):  # fmt: skip
        add(component)
