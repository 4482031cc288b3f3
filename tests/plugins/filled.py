"""Components that are nothing without parts, with some in them: what holds for all components holds for them."""

from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.mutation import OneOf
from pathloom.kernel.repair import InTurn
from pathloom.kernel.sampling import Mixed
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.loops import LoopRemoval
from pathloom.paths.priced_trees import PricedTrees
from pathloom.paths.reroute import Reroute
from pathloom.paths.tree_seeding import PerturbedTrees

FILLED = (
    OneOf(parts=(Reroute(), Reroute(longest=8))),
    RandomImmigrants(sampling=PerturbedTrees(spread=0.5, pairs=300)),  # each from trees of its own
    Mixed(parts=(PerturbedTrees(), PricedTrees()), shares=(1.0, 2.0)),
    InTurn(steps=(LoopRemoval(), PointDeletion())),
)
