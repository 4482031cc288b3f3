"""Section 2.5: adaptive evolution."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from pathloom import Control, Deme, Evolution, Selection, State, Whole
from pathloom_imaga.selection import ThreeStage


@dataclass(frozen=True, kw_only=True)
class AdaptiveEvolution(Control):
    """After a generation that has not improved, select, vary and evaluate its children again, a few times at most.

    The paper contradicts itself on when that is. Eq. (23) goes on while the best
    child is worse than the best parent; the sentence behind it while it is not
    worse; section 2.7 until it has evolved.
    """

    source: ClassVar[str] = "Zhang et al. 2023, section 2.5, eq. (23)"

    threshold: Whole = 3
    """Most repetitions a generation. Not in the paper. Each costs as much as a generation, and in our measurements
    none of them made the answers better."""
    selection: Selection = ThreeStage()
    """Chooses the parents of each repetition."""
    judge: Literal["not-better", "worse"] = "not-better"
    """Go on while the best child is not better than the best parent, or only, as eq. (23) has it, while it is worse."""
    elite: Literal["after", "before"] = "after"
    """Let survival put the best parents back after the judgement. If it does so before, no child is ever worse."""

    def advance(self, planner: Evolution, state: State, which: int, rng: np.random.Generator) -> Deme:
        deme, problem, progress = state.demes[which], state.problem, planner.progress(state)
        best = deme.fitness.max()

        def offspring(of: Deme, selection: Selection) -> Deme:
            parents = selection.select(of.fitness, len(of), rng)
            varied = planner.vary(of.population[parents], of.fitness[parents], problem, progress, rng)
            children = planner.evaluate(varied, problem)
            return planner.survival.survive(deme, children, problem, rng) if self.elite == "before" else children

        children = offspring(deme, planner.selection)
        for _ in range(self.threshold):
            gain = children.fitness.max() - best  # eq. (23), fit_next − fit_pre
            if gain > 0 or (gain == 0 and self.judge == "worse"):
                break
            children = offspring(children, self.selection)
        return children if self.elite == "before" else planner.survival.survive(deme, children, problem, rng)
