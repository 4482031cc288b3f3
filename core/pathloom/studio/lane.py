"""A lane: one run of one planner, which goes on only as far as the page asks."""

import asyncio
import time
from collections.abc import Callable, Coroutine
from contextlib import suppress
from typing import Any

from pathloom.compiled.jit import listening
from pathloom.errors import ConfigError, PathloomError
from pathloom.fronts import verified
from pathloom.kernel.component import Component, members
from pathloom.kernel.compose import compose
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.run import Run
from pathloom.kernel.state import State
from pathloom.kernel.termination import MaxGenerations
from pathloom.multiobjective.running import constraints_of
from pathloom.paths.cell_paths import flat_ids
from pathloom.paths.problem import PathProblem
from pathloom.planning import asked_for, concluded, iterate
from pathloom.studio.frame import frame_of, trade_offs
from pathloom.studio.scene import reachable_problem_of, refusal
from pathloom.studio.wire import WINDOW, Begin, Begun, Compiling, Ended, Front, Generation, Refused, Said
from pathloom.studio.workers import Workers

MOST_INDIVIDUALS = 5000
"""A population on the page has no more."""
EASY = 128 * 128
"""Cells of a map up to which an answer is held against the exact optimum, which takes a moment there."""

Send = Callable[[Said], Coroutine[Any, Any, None]]


class Lane:
    """One run, from the planner's table to the verified answer."""

    def __init__(self, begin: Begin, workers: Workers, send: Send) -> None:
        self.run = begin.run
        self._begin, self._workers, self._send = begin, workers, send
        self._wanted, self._wake = 0, asyncio.Event()
        self._state: State | None = None
        self._task = asyncio.create_task(self._go())

    def more(self, generations: int) -> None:
        """Let it go on for so many generations, up to `WINDOW` ahead."""
        self._wanted = min(self._wanted + generations, WINDOW)
        self._wake.set()

    def stop(self) -> None:
        """Let nobody hear of it any more."""
        self._task.cancel()

    async def _go(self) -> None:
        lane, run = self._begin.lane, self._begin.run
        try:
            await self._search(lane, run)
        except PathloomError as error:
            await self._send(refusal(error, lane, run))
        except (MemoryError, RecursionError) as error:
            found = "too little memory" if isinstance(error, MemoryError) else "parts within parts without end"
            await self._send(Refused("planner", f"planner: found {found}; take less of it", lane, run))
        except Exception as error:  # a defect, or a plugin's: said, never lost
            shown = f"{type(error).__name__}: {error}"
            await self._send(Refused("", f"a defect, please report it: {shown}", lane, run))

    async def _search(self, lane: int, run: int) -> None:
        planner, problem = await self._workers.do(self._prepare)
        await self._send(Begun(lane, run, planner.name, list(planner.terms.labels), _most_generations(planner)))
        states = iterate(problem, planner, seed=self._begin.asked.seed)
        loop = asyncio.get_running_loop()

        def tell(done: int, of: int) -> None:
            with suppress(RuntimeError):  # the server has ended meanwhile
                asyncio.run_coroutine_threadsafe(self._send(Compiling(lane, run, done, of)), loop)

        def step() -> Generation | None:
            with listening(tell):
                state = next(states, None)
            self._state = state or self._state
            return None if state is None else frame_of(state, planner, problem, lane, run)

        await self._asked()
        while (frame := await self._workers.do(step)) is not None:
            await self._send(frame)
            await self._asked()
        await self._send(await self._workers.do(lambda: self._conclude(problem, planner)))

    async def _asked(self) -> None:
        while self._wanted == 0:
            self._wake.clear()
            await self._wake.wait()
        self._wanted -= 1

    def _prepare(self) -> tuple[Planner, PathProblem]:
        asked = self._begin.asked
        planner = compose(asked.planner)
        _check_size(planner)
        return planner, reachable_problem_of(asked.scene)

    def _conclude(self, problem: PathProblem, planner: Planner) -> Ended:
        asked, state, began = self._begin.asked, self._state, time.perf_counter()
        assert state is not None, "a run has one state at least"
        outcome = planner.result(state)
        phases = {"evolution": state.seconds, "refinement": time.perf_counter() - began, "loading": 0.0}
        facts = asked_for(problem, planner, asked.seed, None, asked.scene.name or "studio")
        optimum = problem.grid.occupied.size <= EASY
        result = concluded(problem, planner, Run(state, outcome, phases), phases, facts, optimum=optimum)
        path = [] if result.path is None else flat_ids(result.path, problem.grid.width).tolist()
        curve = [] if result.curve is None else [(float(r), float(c)) for r, c in result.curve.points]
        front = _verified_front(problem, planner, state)
        return Ended(self._begin.lane, self._begin.run, path, curve, result.to_dict(), front)


def _most_generations(planner: Planner) -> int | None:
    limits = [one.limit for one in planner.termination if isinstance(one, MaxGenerations)]
    return min(limits, default=None)


def _check_size(component: Component) -> None:
    """Refuse populations that nobody could look at, wherever they stand in a planner."""
    for name in ("population", "ants"):
        size = getattr(component, name, 0)
        if isinstance(size, int) and size > MOST_INDIVIDUALS:
            raise ConfigError(f"planner: {name}: found {size}, allowed here at most {MOST_INDIVIDUALS}")
    for _, part in members(component):
        _check_size(part)


def _verified_front(problem: PathProblem, planner: Planner, state: State) -> Front | None:
    if not isinstance(planner, FrontPlanner):
        return None
    found = verified(planner.front(state), problem, planner.objectives, constraints_of(planner))
    return trade_offs(found.values, [flat_ids(path, problem.grid.width).tolist() for path in found.paths])
