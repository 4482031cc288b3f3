"""States: all that a run has reached is in its state, which is data."""

import pickle
from typing import Any

from pathloom.kernel.planner import Planner
from pathloom.kernel.run import first_generator
from pathloom.testing.calls import on_cells, short
from pathloom.testing.check import Inapplicable, expect, promise
from pathloom.testing.plain import plain
from pathloom.testing.problems import places


@promise("resumed", Planner, where=on_cells)
def resumed(component: Any) -> None:
    """From a state that was kept, the next step is the same: all that it has reached is in the state."""
    planner, problem = short(component), next(places()).problem()
    state = planner.start(problem, first_generator(5))
    kept = pickle.dumps(state)
    if planner.done(state):
        raise Inapplicable("it is done at once")
    first = planner.step(state)
    planner.step(first)
    expect(plain(pickle.loads(kept)) == plain(state), "expected a state as it was after a step; found it changed")  # noqa: S301
    again = planner.step(pickle.loads(kept))  # noqa: S301 - pickled here
    expect(plain(again) == plain(first), f"expected one state of one state; found\n{first}\nand\n{again}")


CHECKS = (resumed,)
