"""Every component that comes with pathloom keeps the promises that a component of anybody makes."""

import pytest

from pathloom.kernel.immigrants import RandomImmigrants
from pathloom.kernel.mutation import OneOf
from pathloom.kernel.registry import default_registry
from pathloom.kernel.repair import InTurn
from pathloom.kernel.sampling import Mixed
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.loops import LoopRemoval
from pathloom.paths.priced_trees import PricedTrees
from pathloom.paths.reroute import Reroute
from pathloom.paths.tree_seeding import PerturbedTrees
from pathloom.testing import Inapplicable, checks_for
from pathloom.testing.package import Promise, promises_of

FILLED = (
    OneOf(parts=(Reroute(), Reroute(longest=8))),
    RandomImmigrants(sampling=PerturbedTrees(spread=0.5, pairs=300)),
    Mixed(parts=(PerturbedTrees(), PricedTrees()), shares=(1.0, 2.0)),
    InTurn(steps=(LoopRemoval(), PointDeletion())),
)
"""Components that are nothing without parts, with others in them than the kit would take."""

OURS = [n for n in default_registry().namespaces if default_registry().source(n).ours]
PROMISES = [promise for namespace in OURS for promise in promises_of(namespace)]
PROMISES += [Promise(f"filled/{one.name}", one, check) for one in FILLED for _, check in checks_for(one)]


@pytest.mark.parametrize("promise", PROMISES, ids=str)
def test_our_components_keep_what_all_promise(promise: Promise) -> None:
    try:
        promise()
    except Inapplicable as reason:
        pytest.skip(str(reason))
