"""Budget: what every run of a study may spend, the same for all variants."""

import math
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

from pathloom.errors import ConfigError
from pathloom.kernel.planner import Planner
from pathloom.kernel.termination import MaxEvaluations, MaxGenerations, Termination, WallTime
from pathloom.naming import closest

Measure = Literal["evaluations", "generations", "seconds", "own"]

LIMITS = (MaxGenerations, MaxEvaluations, WallTime)
"""Terminations that limit how much is spent; all others stop because of what was reached, and stay."""


@dataclass(frozen=True)
class Budget:
    """How much every run may spend.

    It takes the place of a planner's own limits of generations, evaluations and
    time. Terminations that look at what was reached, such as stagnation, belong
    to the method and stay; and a planner that ends by itself is not made to go on.
    """

    of: Measure = "evaluations"
    """What is counted. ``own``: every planner keeps the limits that it brings, however different they are."""
    limit: float | None = None
    """How much. Empty: what the base spends if it is let; of planners that are compared, the most that any spends.

    It is measured with the first map and seed, on which the number rarely depends.
    """

    @classmethod
    def parse(cls, asked: "str | Budget") -> "Budget":
        """Return the budget that ``evaluations``, ``evaluations=5000``, ``seconds=2`` or ``own`` stands for.

        Raises
        ------
        ConfigError
            If it is none of these.
        """
        if isinstance(asked, Budget):
            return asked
        of, equals, text = (part.strip() for part in str(asked).partition("="))
        if of not in get_args(Measure):
            raise ConfigError(f"budget: found {of!r}, allowed evaluations, generations, seconds or own, "
                              f"as in evaluations=5000; {closest(of, get_args(Measure))}")  # fmt: skip
        if of == "own" or not equals:
            if of == "seconds" or equals:
                raise ConfigError(f"budget: found {asked!r}, allowed " + ("own" if of == "own" else "seconds=NUMBER"))
            return cls(of)  # type: ignore[arg-type]
        try:
            limit = float(text) if of == "seconds" else int(text)
        except ValueError:
            limit = math.nan
        if not 0 < limit < math.inf:
            kind = "a number" if of == "seconds" else "a whole number"
            raise ConfigError(f"budget: found {of}={text}, allowed {kind} above 0")
        return cls(of, limit)  # type: ignore[arg-type]

    @property
    def open(self) -> bool:
        """Whether the limit is still to be measured."""
        return self.of != "own" and self.limit is None

    def applied(self, planner: Planner) -> Planner:
        """Return the planner with this budget in place of its own limits."""
        if self.of == "own":
            return planner
        assert self.limit is not None, "an open budget is measured first"
        kept = [t for t in planner.termination if not isinstance(t, LIMITS)]
        limits: list[Termination]
        if self.of == "seconds":
            limits = [WallTime(seconds=self.limit)]
        elif self.of == "generations":
            limits = [MaxGenerations(limit=int(self.limit))]
        else:
            limits = [MaxEvaluations(limit=int(self.limit))]
            own = [t.limit for t in planner.termination if isinstance(t, MaxGenerations)]
            if own:  # generations that measure nothing must come to an end as well
                limits.append(MaxGenerations(limit=max(int(self.limit), *own)))
        return replace(planner, termination=(*limits, *kept))

    def refuse_swapped(self, slot: str) -> None:
        """Refuse a design that swaps what the budget replaces."""
        if slot.partition(".")[0] == "termination" and self.of != "own":
            raise ConfigError(
                f"swap {slot}: the budget of {self.of} takes its place; let every variant have its own: --budget own"
            )

    def __str__(self) -> str:
        if self.of == "own":
            return "each planner's own limits"
        return f"{self.limit:g} {self.of}" if self.limit is not None else f"as many {self.of} as measured"

    def table(self) -> dict[str, Any]:
        """Return what a study writes down of it."""
        return {"of": self.of, "limit": self.limit}


def unhurried(planner: Planner) -> Planner:
    """Return the planner with nothing but its own limits, to see how much it spends if it is let."""
    limits = [t for t in planner.termination if isinstance(t, LIMITS) and not isinstance(t, WallTime)]
    return replace(planner, termination=tuple(limits)) if limits else planner
