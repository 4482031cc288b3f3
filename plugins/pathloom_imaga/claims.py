"""Sections 3 and 4: what the paper reports, to be measured again. Section 2 is in ``claims_of_parts``.

A length counts as met within 1 %, and as met in direction within 4 %; a number
of turns within 5 % and 15 %. The paper gives two decimals of means over 50 runs
of methods whose parameters it leaves out, so that more cannot be asked.
"""

from abc import ABC
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

import numpy as np

from pathloom import Bench, Claim, Finding, PathProblem, Result, iterate
from pathloom.claims import NEEDS_DATA, Verdict, smaller, untestable, verdict

MAPS: dict[int, tuple[str, dict[str, str]]] = {
    75: ("ga_grids/ga_smooth_20x20.csv", {"start": "top-left", "goal": "bottom-right"}),
    102: ("ga_grids/ssa_20x20.csv", {}),
}
"""The maps of figs. 10 and 11 by their obstacles, recovered: counts, optima and several results coincide."""

OURS = "imaga"
METHODS = {"ga-imaga": "GA", "aco-ga": "ACO-GA", "ssa": "SSA", OURS: "IMAGA"}
Row = tuple[float, float, float, float, float]
"""Best length, mean length, mean seconds, mean turns, energy per length."""
ROWS: dict[int, dict[str, Row]] = {
    75: {
        "ga-imaga": (30.9706, 32.0219, 2.2454, 14.16, 1.442),
        "aco-ga": (29.8586, 31.0273, 4.2031, 8.46, 1.272),
        "ssa": (29.8585, 31.5068, 3.8463, 5.86, 1.186),
        OURS: (29.6896, 30.2773, 2.2188, 6.32, 1.209),
    },
    102: {
        "ga-imaga": (28.6274, 28.8734, 1.6803, 11.04, 1.382),
        "aco-ga": (27.5602, 28.2973, 4.4388, 6.50, 1.229),
        "ssa": (27.5603, 27.7814, 3.5681, 6.04, 1.217),
        OURS: (27.5155, 27.6039, 2.7547, 3.00, 1.109),
    },
}

Runs = Mapping[str, list[Result]]
Judged = tuple[str, Verdict]
PATHLESS = 1e6
"""What a run without a path counts for where lengths are compared."""


def lengths(runs: list[Result]) -> list[float]:
    """Return the length that each run reached."""
    return [round(min(r.length, PATHLESS), 9) for r in runs]  # equal paths may differ in the last digit


def mean(runs: list[Result], what: str = "length") -> float:
    """Return the mean of a metric over the runs that found a path."""
    return float(np.mean([r.metrics[what] for r in runs if r.found]))


def seconds(runs: list[Result]) -> float:
    """Return the mean time of a run."""
    return float(np.mean([r.budget["seconds"] for r in runs]))


def settled(runs: list[Result]) -> float:
    """Return the median of the generations from which the fitness is within 1 % of the final one."""
    found = [r.history["best"] for r in runs if r.found]
    return float(np.median([next(k for k, f in enumerate(best) if f >= 0.99 * best[-1]) for best in found]))


def near(measured: tuple[float, ...], printed: tuple[float, ...], tolerance: float) -> bool:
    """Whether every number is within a share of the printed one."""
    return all(abs(m / p - 1) <= tolerance for m, p in zip(measured, printed, strict=True))


def _seeds(bench: Bench, method: str) -> int:
    return bench.seeds(50, 15 if method == "ssa" else 20)  # which takes as long as all the others


def of_found(runs: list[Result]) -> str:
    """Return how many found a path, where not all of them did."""
    found = sum(r.found for r in runs)
    return "" if found == len(runs) else f"; a path in {found} of {len(runs)} runs"


def without_evolution(runs: list[Result]) -> dict[str, Any]:
    """Return a planner that draws as many paths as these runs refined, deletes points, and evolves nothing."""
    drawn = round(float(np.mean([r.budget["counts"]["refined"] for r in runs])))
    return {
        "use": OURS, "population": drawn, "crossover": "none", "mutation": "none", "control": "generational",
        "termination": [{"use": "max-generations", "limit": 1}],
    }  # fmt: skip


WITH_DELETION: dict[str, Any] = {
    "use": "ga-imaga",
    "refinement": {"use": "point-deletion", "passes": 0},
    "archive": {"use": "best-refined", "objective": "length"},
}
"""GA with what gives IMAGA its answer."""


def generated(bench: Bench) -> list[PathProblem]:
    """Return random maps like that of fig. 10, with 75 obstacles."""
    return [bench.problem(f"random-20:75:s{k}") for k in range(bench.seeds(10, 5))]


def on_all(bench: Bench, planner: str | Mapping[str, Any], problems: list[PathProblem]) -> list[Result]:
    """Return runs on each of the maps."""
    return [r for problem in problems for r in bench.runs(planner, problem, bench.seeds(10, 3))]


@dataclass(frozen=True, kw_only=True)
class Table(Claim, ABC):
    """Four methods on one map, 50 runs each."""

    number: ClassVar[int]
    obstacles: ClassVar[int]

    def examine(self, bench: Bench) -> Iterator[Finding]:
        file, ends = MAPS[self.obstacles]
        problem = bench.recovered(file, **ends)
        runs = {m: bench.runs(m, problem, _seeds(bench, m)) for m in METHODS} if problem is not None else {}
        place = f"table {self.number}"
        for says, judge in self._statements():
            if problem is None:
                yield untestable(place, says, NEEDS_DATA)
            else:
                yield Finding(place, says, *judge(runs), timed=judge == self._times)

    def _statements(self) -> Iterator[tuple[str, Callable[[Runs], Judged]]]:
        rows = ROWS[self.obstacles]
        for method, label in METHODS.items():
            best, average, _, turns, energy = rows[method]
            yield f"{label}: best {best:.4f}, mean {average:.4f}", partial(self._row, method=method)
            yield f"{label}: {turns:.2f} turns, energy {energy}", partial(self._turns, method=method)
        yield "mean length of IMAGA less than that of GA, ACO-GA and SSA", self._shorter
        order = sorted(METHODS, key=lambda m: rows[m][1])
        yield f"order of the means: {', '.join(METHODS[m] for m in order)}", self._order
        yield "IMAGA has fewer turns than all others, and so needs less energy", self._fewer_turns
        yield "IMAGA is the most stable", self._spread
        yield f"mean time {', '.join(f'{METHODS[m]} {rows[m][2]:.4f}' for m in METHODS)} s", self._times

    def _row(self, runs: Runs, method: str) -> Judged:
        found, printed = runs[method], ROWS[self.obstacles][method][:2]
        measured = min(lengths(found)), mean(found)
        text = f"best of {len(found)} {measured[0]:.4f}, mean {measured[1]:.4f}{of_found(found)}"
        every = all(r.found for r in found)
        return text, verdict(every and near(measured, printed, 0.01), every and near(measured, printed, 0.04))

    def _turns(self, runs: Runs, method: str) -> Judged:
        found, printed = runs[method], ROWS[self.obstacles][method][3:4]
        turns = mean(found, "turns")
        energy = np.mean([1 + r.metrics["turns"] / r.length for r in found if r.found])
        text = f"{turns:.2f} turns, energy {energy:.3f}{of_found(found)}"
        every = all(r.found for r in found)
        return text, verdict(every and near((turns,), printed, 0.05), every and near((turns,), printed, 0.15))

    def _shorter(self, runs: Runs) -> Judged:
        ours = lengths(runs[OURS])
        others = {label: lengths(runs[m]) for m, label in METHODS.items() if m != OURS}
        leads = {label: smaller(ours[: len(theirs)], theirs) for label, theirs in others.items()}
        text = f"shorter than {', '.join(f'{label} in {lead}' for label, lead in leads.items())}"
        return text, verdict(all(lead.p < 0.05 for lead in leads.values()))

    def _order(self, runs: Runs) -> Judged:
        rows = ROWS[self.obstacles]
        found = {m: mean(runs[m]) for m in METHODS}
        order = sorted(METHODS, key=found.__getitem__)
        said = sorted(METHODS, key=lambda m: rows[m][1])
        return ", ".join(f"{METHODS[m]} {found[m]:.2f}" for m in order), verdict(order == said, order[0] == OURS)

    def _fewer_turns(self, runs: Runs) -> Judged:
        rows = ROWS[self.obstacles]
        found = {m: mean(runs[m], "turns") for m in METHODS}
        text = "; ".join(f"{METHODS[m]} {found[m]:.2f}" for m in METHODS)
        fewer = [m for m in METHODS if rows[m][3] < rows[OURS][3]]
        if fewer:
            text += f"; in the table itself {METHODS[fewer[0]]} has {rows[fewer[0]][3]}, IMAGA {rows[OURS][3]}"
        return text, verdict(not fewer and min(found, key=found.__getitem__) == OURS)

    def _spread(self, runs: Runs) -> Judged:
        found = {m: float(np.std([r.length for r in runs[m] if r.found])) for m in METHODS}
        text = f"standard deviation of the lengths: {', '.join(f'{METHODS[m]} {found[m]:.3f}' for m in METHODS)}"
        wider, far_wider = (sum(found[m] > factor * found[OURS] + 1e-9 for m in METHODS) for factor in (1.0, 1.5))
        return text, verdict(far_wider == 3, wider >= 2)

    def _times(self, runs: Runs) -> Judged:
        rows = ROWS[self.obstacles]
        took = {m: seconds(runs[m]) for m in METHODS}
        text = f"{', '.join(f'{METHODS[m]} {took[m]:.3f}' for m in METHODS)} s"
        said = sorted(METHODS, key=lambda m: rows[m][2])
        hybrid = took[OURS] < min(took["aco-ga"], took["ssa"])  # which is so in both tables
        return text, verdict(sorted(METHODS, key=took.__getitem__) == said, hybrid)


@dataclass(frozen=True, kw_only=True)
class Table1(Table):
    """Four methods on the map with 75 obstacles."""

    source: ClassVar[str] = "Zhang et al. 2023, section 3, table 1"
    number: ClassVar[int] = 1
    obstacles: ClassVar[int] = 75


@dataclass(frozen=True, kw_only=True)
class Table2(Table):
    """Four methods on the map with 102 obstacles."""

    source: ClassVar[str] = "Zhang et al. 2023, section 3, table 2"
    number: ClassVar[int] = 2
    obstacles: ClassVar[int] = 102


@dataclass(frozen=True, kw_only=True)
class Figure12(Claim):
    """IMAGA comes to its best path in fewer generations."""

    source: ClassVar[str] = "Zhang et al. 2023, section 3, fig. 12, and abstract"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        path = "the best path is found in fewer generations than by GA, ACO-GA and SSA"
        curve = "the curve of the best settles in fewer generations than theirs"
        problems = {k: bench.recovered(file, **ends) for k, (file, ends) in MAPS.items()}
        if None in problems.values():
            yield from (untestable("fig. 12", says, NEEDS_DATA) for says in (path, curve))
            return
        seeds = _seeds(bench, OURS)
        texts: tuple[list[str], list[str]] = [], []
        firsts: tuple[list[bool], list[bool]] = [], []
        for obstacles, problem in problems.items():
            assert problem is not None
            runs = {m: bench.runs(m, problem, _seeds(bench, m)) for m in METHODS}
            born = {m: float(np.median([r.convergence or 0 for r in runs[m] if r.found])) for m in METHODS}
            answers = [_last(problem, seed).answer.generation for seed in range(seeds)]
            born[OURS] = float(np.median(answers))
            stable = {m: settled(runs[m]) for m in METHODS}
            latest = f", at the latest {max(answers)}"
            for measured, text, first in zip((born, stable), texts, firsts, strict=True):
                generations = ", ".join(f"{METHODS[m]} {measured[m]:.0f}" for m in METHODS)
                text.append(f"{obstacles} obstacles: {generations}{latest if measured is born else ''}")
                first.append(measured[OURS] < min(measured[m] for m in METHODS if m != OURS))
        for says, text, first in zip((path, curve), texts, firsts, strict=True):
            what = "medians; " if says == path else "fitness within 1 % of the final one, medians; "
            yield Finding("fig. 12", says, what + "; ".join(text), verdict(all(first), any(first)))


def _last(problem: PathProblem, seed: int) -> Any:
    """Return the state in which a run ends, which knows when its answer was found."""
    *_, last = iterate(problem, OURS, seed=seed)
    return last


@dataclass(frozen=True, kw_only=True)
class Controls(Claim):
    """What the paper does not compare with: the sampler and the deletion alone, and GA with the same deletion."""

    source: ClassVar[str] = "Zhang et al. 2023, sections 2.3 to 2.6, 3 and 4"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        evolution = "adaptive evolution shortens the paths ({} obstacles)"
        operators = "the improvements of GA shorten the paths ({} obstacles)"
        for obstacles, (file, ends) in MAPS.items():
            problem = bench.recovered(file, **ends)
            if problem is None:
                yield untestable("section 4, control", evolution.format(obstacles), NEEDS_DATA)
                yield untestable("section 4, control", operators.format(obstacles), NEEDS_DATA)
                continue
            yield from self._compared(bench, [problem], _seeds(bench, OURS), f"{obstacles}", evolution, operators)
        problems = generated(bench)
        yield from self._compared(bench, problems, bench.seeds(10, 3), "random maps, 75", evolution, operators)

    @staticmethod
    def _compared(
        bench: Bench, problems: list[PathProblem], seeds: int, where: str, evolution: str, operators: str
    ) -> Iterator[Finding]:
        ours, drawn, plain, numbers = [], [], [], []
        for problem in problems:
            runs = bench.runs(OURS, problem, seeds)
            alone = without_evolution(runs)
            numbers.append(alone["population"])
            ours += lengths(runs)
            drawn += lengths(bench.runs(alone, problem, seeds))
            plain += lengths(bench.runs(WITH_DELETION, problem, seeds))
        paths = f"{min(numbers)} to {max(numbers)}" if len(numbers) > 1 else f"{numbers[0]}"
        for says, others, what in (
            (evolution, drawn, f"{paths} paths sampled, points deleted, nothing evolved"),
            (operators, plain, "GA with the deletion of section 2.6, as IMAGA has it"),
        ):
            lead = smaller(ours, others)
            text = f"{what}: mean {np.mean(others):.4f}; IMAGA {np.mean(ours):.4f}, shorter in {lead}"
            yield Finding("section 4, control", says.format(where), text, verdict(lead.p < 0.05))
