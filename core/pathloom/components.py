"""The components that belong to no paper, registered through the same hook as everybody's."""

from pathloom.draw.live import Live
from pathloom.exact.aloof import Aloof
from pathloom.exact.planners import AnyAngle, Dijkstra
from pathloom.exact.scalarised import Scalarised
from pathloom.kernel.archive import BestRefined
from pathloom.kernel.evaluation import ReciprocalOfSum, WeightedReciprocals
from pathloom.kernel.evolution import Evolution, Generational
from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.json_lines import JsonLines
from pathloom.kernel.memetic import Memetic
from pathloom.kernel.mutation import OneOf
from pathloom.kernel.plugins import Add, hookimpl
from pathloom.kernel.progress import Progress
from pathloom.kernel.repair import InTurn
from pathloom.kernel.sampling import Mixed
from pathloom.kernel.selection import ConsecutivePairs, RandomPairs, Roulette, Tournament
from pathloom.kernel.snapshots import Snapshots
from pathloom.kernel.survival import BestOfBoth, KeepBest, Replacement
from pathloom.kernel.termination import MaxEvaluations, MaxGenerations, Stagnation, TargetFitness, WallTime
from pathloom.local.classifiers import Classifier
from pathloom.local.drivers.avoiding import Avoiding
from pathloom.local.drivers.dynamic_window import DynamicWindow
from pathloom.local.drivers.guarded import Guarded
from pathloom.local.drivers.policy_alone import PolicyAlone
from pathloom.local.drivers.pure_pursuit import PurePursuit
from pathloom.local.driving import ClosedLoop
from pathloom.local.hazards import Hazards
from pathloom.local.robot import Robot
from pathloom.local.rules import FourLeaves, WallFollower
from pathloom.local.sensing import Ultrasound
from pathloom.paths.ants.ant_system import AntSystem, Die, GoalDistance, MaxMin, Retreat, Uniform
from pathloom.paths.ants.colony import Colony
from pathloom.paths.collision import Exact
from pathloom.paths.constraints import Bound
from pathloom.paths.curves import BSpline, CubicBezier
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.exchange import SharedNode
from pathloom.paths.loops import LoopRemoval
from pathloom.paths.objectives import Clearance, Length, ObstaclesBeside, TurnAngle, Turns, UnsafeCells
from pathloom.paths.priced_trees import PricedTrees
from pathloom.paths.reroute import Reroute
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom.paths.vectors.decoding import Rows, Waypoints


@hookimpl
def register(add: Add) -> None:
    """Add what needs no prefix."""
    for component in (
        Evolution, Generational, Memetic, BestRefined,
        Dijkstra, AnyAngle,
        PerturbedTrees, PricedTrees, Scalarised, Aloof, Mixed, Bound,
        Length, UnsafeCells, ObstaclesBeside, Turns, TurnAngle, Clearance,
        ReciprocalOfSum, WeightedReciprocals,
        Roulette, Tournament, RandomPairs, ConsecutivePairs,
        Replacement, KeepBest, BestOfBoth,
        SharedNode, Reroute, RandomImmigrants, OneOf,
        PointDeletion, LoopRemoval, InTurn, Exact,
        BSpline, CubicBezier,
        Colony, GoalDistance, Uniform, AntSystem, MaxMin, Die, Retreat,
        Rows, Waypoints,
        FourLeaves, WallFollower, Classifier,
        PurePursuit, Avoiding, Guarded, PolicyAlone, DynamicWindow, ClosedLoop, Robot, Ultrasound, Hazards,
        MaxGenerations, MaxEvaluations, Stagnation, TargetFitness, WallTime,
        Progress, JsonLines, Snapshots, Live,
    ):  # fmt: skip
        add(component)
