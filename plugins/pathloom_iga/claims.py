"""Section 4: what the paper reports, to be measured again. Section 3 is in ``claims_of_parts``."""

import math
from abc import ABC
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Bench, Claim, Finding, Result
from pathloom.claims import smaller, untestable, verdict

OURS = "iga"
ADAPTIVE: dict[str, Any] = {"use": OURS, "migration": "none", "repair": "none"}
"""Section 4.1."""
TRADITIONAL: dict[str, Any] = {
    **ADAPTIVE,
    "crossover": {"probability": "none", "rate": 0.8},
    "mutation": {"probability": "none", "rate": 0.05},
}
DELETING: dict[str, Any] = {"use": OURS, "migration": "none"}
"""Section 4.2: adaptive, with loop removal and point deletion."""
LONE: dict[str, Any] = {**DELETING, "population": 600}
"""As many individuals as both populations have, in one."""

METHODS = {OURS: "IGA", "ga-iga": "GA", "pso": "PSO", "afsa": "AFSA", "gwo": "GWO"}
OTHERS = {name: label for name, label in METHODS.items() if name != OURS}
WITH_DELETION: dict[str, Any] = {
    "use": "ga-iga",
    "refinement": {"use": "point-deletion", "passes": 0},
    "archive": {"use": "best-refined", "objective": "length"},
}
"""GA with points deleted of each of its paths, which are not put back."""

PATHLESS = 1e6
"""What a run without a path counts for where lengths are compared."""


def lengths(runs: Sequence[Result]) -> list[float]:
    """Return the length that each run reached."""
    return [round(min(r.length, PATHLESS), 9) for r in runs]  # equal paths may differ in the last digit


def mean(runs: Sequence[Result], what: str = "length") -> float:
    """Return the mean of a metric over the runs that found a path."""
    return float(np.mean([r.metrics[what] for r in runs if r.found]))


def generations(runs: Sequence[Result]) -> list[int]:
    """Return for each run the generation whose best is first as good as the final one, but for rounding."""
    histories = [np.array(r.history["best"]) for r in runs]
    return [int(np.argmax(best >= best[-1] * (1 - 1e-12))) for best in histories]


def excess(runs: Sequence[Result]) -> list[float]:
    """Return how much longer than its shortest path a population is, by fitness, on the mean of all generations."""
    constant = 0.01  # of eq. (5), as the planner has it
    histories = [(np.array(r.history["generation_best"]), np.array(r.history["mean"])) for r in runs]
    return [100 * float(np.mean((best - constant) / (mean - constant) - 1)) for best, mean in histories]


def lost(runs: Sequence[Result]) -> list[float]:
    """Return in how many generations of 100 the best is worse than in the one before."""
    return [100 * float(np.mean(np.diff(r.history["generation_best"]) < -1e-12)) for r in runs]


def on_map_1(bench: Bench, planner: str | Mapping[str, Any]) -> list[Result]:
    """Return runs on the printed map."""
    return bench.runs(planner, bench.problem("iga-map1"), bench.seeds(100, 15))


def at_random(bench: Bench, planner: str | Mapping[str, Any]) -> list[Result]:
    """Return runs on five random maps like that of table 1."""
    problems = [bench.problem(f"random-20:75:s{k}") for k in range(5)]
    return [r for problem in problems for r in bench.runs(planner, problem, bench.seeds(20, 3))]


@dataclass(frozen=True, kw_only=True)
class Section41(Claim):
    """Adaptive probabilities."""

    source: ClassVar[str] = "Liu et al. 2024, section 4.1, fig. 5"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        fixed, adaptive = on_map_1(bench, TRADITIONAL), on_map_1(bench, ADAPTIVE)
        fixed_too, adaptive_too = at_random(bench, TRADITIONAL), at_random(bench, ADAPTIVE)
        for says, measure, unit in (
            ("adaptive probabilities converge faster than 0.8 and 0.05", generations, "generations to the best"),
            ("the mean of the adaptive population is nearer to the best", excess, "% longer than the best"),
        ):
            here = measure(adaptive), measure(fixed)
            there = measure(adaptive_too), measure(fixed_too)
            nearer = np.mean(here[0]) < np.mean(here[1]) and np.mean(there[0]) < np.mean(there[1])
            both = smaller([*here[0], *there[0]], [*here[1], *there[1]])
            yield Finding(
                "section 4.1, fig. 5",
                says,
                f"{unit}: {np.mean(here[0]):.1f} against {np.mean(here[1]):.1f} on map 1, less in {smaller(*here)}; "
                f"{np.mean(there[0]):.1f} against {np.mean(there[1]):.1f} on random maps, less in {smaller(*there)}; "
                f"together p = {both.p:.2g}",
                verdict(nearer and both.p < 0.05, nearer),
            )


@dataclass(frozen=True, kw_only=True)
class Section42(Claim):
    """Deletion and optimisation operators on map 1."""

    source: ClassVar[str] = "Liu et al. 2024, section 4.2, figs. 6 to 9"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        before, after = on_map_1(bench, ADAPTIVE), on_map_1(bench, DELETING)
        long, short = min(lengths(before)), min(lengths(after))
        yield Finding(
            "section 4.2",
            "without the two operators the best path of map 1 is 14.3",
            f"{long:.4f}, mean of {len(before)} {mean(before):.4f}, the shortest of single steps; 14.3 would be "
            f"5 + 5√2 + √5 = {5 + 5 * math.sqrt(2) + math.sqrt(5):.4f}, with two steps in one",
            verdict(round(long, 1) == 14.3, abs(long / 14.3 - 1) < 0.02),
        )
        yield Finding(
            "section 4.2",
            "with them it is 13.8",
            f"{short:.4f}, mean of {len(after)} {mean(after):.4f}, the any-angle optimum",
            verdict(round(short, 1) == 13.8),
        )
        gain = 100 * (1 - short / long)
        yield Finding(
            "section 4.2", "which is 4 % less", f"{gain:.1f} %; 14.3 to 13.8 is {100 * (1 - 13.8 / 14.3):.1f} %",
            verdict(round(gain) == 4, gain > 0),
        )  # fmt: skip
        average = 100 * (1 - mean(after) / mean(before))
        yield Finding(
            "section 4.2, fig. 7",
            "the mean of 100 runs is 6 % shorter",
            f"{average:.1f} %",
            verdict(round(average) == 6, smaller(lengths(after), lengths(before)).p < 0.05),
        )
        here = generations(after), generations(before)
        there = generations(at_random(bench, DELETING)), generations(at_random(bench, ADAPTIVE))
        leads = smaller(*here), smaller(*there)
        yield Finding(
            "section 4.2, fig. 7",
            "and converges faster",
            f"generations to the best: {np.mean(here[0]):.1f} against {np.mean(here[1]):.1f} on map 1, fewer in "
            f"{leads[0]}; {np.mean(there[0]):.1f} against {np.mean(there[1]):.1f} on random maps, fewer in {leads[1]}",
            verdict(leads[0].p < 0.05 and leads[1].p < 0.05, leads[0].p < 0.05),
        )
        turns = mean(after, "turns"), mean(before, "turns")
        yield Finding(
            "section 4.2, figs. 8, 9",
            "the path is smoother",
            f"{turns[0]:.1f} turns against {turns[1]:.1f}",
            verdict(turns[0] < turns[1]),
        )


@dataclass(frozen=True, kw_only=True)
class Section37(Claim):
    """The reference population."""

    source: ClassVar[str] = "Liu et al. 2024, abstract and sections 3.7 and 5"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        whole, without, lone = (at_random(bench, planner) for planner in (OURS, DELETING, LONE))
        counted = generations(whole), generations(without), generations(lone)
        lead = smaller(counted[0], counted[1])
        yield Finding(
            "section 5",
            "the reference population greatly accelerates convergence",
            f"{np.mean(counted[0]):.1f} generations to the best on random maps, {np.mean(counted[1]):.1f} without it; "
            f"fewer in {lead}",
            verdict(lead.p < 0.05),
        )
        two, without_it, one = (float(np.mean(c)) for c in counted)
        yield Finding(
            "section 5, control",
            "it is the exchange that accelerates, not the number of individuals",
            f"{one:.1f} with one population of 600; two of 300 need fewer in {smaller(counted[0], counted[2])}; so "
            f"{100 * (one - two) / (without_it - two):.0f} % of the gain is the exchange's",
            verdict(one - two > without_it - one, two < one),
        )
        steady = lost(whole), lost(without)
        lead = smaller(*steady)
        yield Finding(
            "section 5",
            "it enhances the stability of the population",
            f"the best is lost in {np.mean(steady[0]):.1f} of 100 generations, {np.mean(steady[1]):.1f} without it; "
            f"less often in {lead}",
            verdict(lead.p < 0.05),
        )


Row = tuple[float, float, float]
"""Length, seconds, success in per cent."""
Range = tuple[int, int]
"""Per cent."""


@dataclass(frozen=True, kw_only=True)
class Table(Claim, ABC):
    """Five methods on random maps, 100 runs each."""

    number: ClassVar[int]
    map: ClassVar[str]
    rows: ClassVar[dict[str, Row]]
    stated: ClassVar[tuple[Range, Range, Range]]
    """By how much the text says that length and time become less, and success more."""

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problems = [bench.problem(f"{self.map}:s{k}") for k in range(5)]
        seeds = bench.seeds(20, 1)
        runs = {m: [r for problem in problems for r in bench.runs(m, problem, seeds)] for m in METHODS}
        yield from self._lengths(runs)
        yield self._control(runs, [r for problem in problems for r in bench.runs(WITH_DELETION, problem, seeds)])
        yield self._times(runs)
        yield self._success(runs)
        yield from self._stated()

    @property
    def place(self) -> str:
        """Where it stands."""
        return f"table {self.number}"

    def _lengths(self, runs: Mapping[str, list[Result]]) -> Iterator[Finding]:
        ours, printed = runs[OURS], self.rows[OURS][0]
        for name, label in OTHERS.items():
            theirs = self.rows[name][0]
            lead = smaller(lengths(ours), lengths(runs[name]))
            yield Finding(
                self.place,
                f"length: IGA {printed}, {label} {theirs}, {100 * (1 - printed / theirs):.1f} % less",
                f"{mean(ours):.4f} and {mean(runs[name]):.4f}, {100 * (1 - mean(ours) / mean(runs[name])):.1f} % less; "
                f"shorter in {lead}",
                verdict(False, lead.p < 0.05),  # the map is not known, and so the numbers cannot be met
            )

    def _control(self, runs: Mapping[str, list[Result]], deleted: list[Result]) -> Finding:
        lead = smaller(lengths(runs[OURS]), lengths(deleted))
        ours, plain, other = mean(runs[OURS]), mean(runs["ga-iga"]), mean(deleted)
        return Finding(
            f"{self.place}, control",
            "IGA is shorter than GA",
            f"GA with its points deleted too {other:.4f}, IGA {ours:.4f}: of {100 * (1 - ours / plain):.2f} % less "
            f"{100 * (1 - ours / other):.2f} % is left; shorter in {lead}",
            verdict(other - ours > 0.5 * (plain - ours)),
        )

    def _times(self, runs: Mapping[str, list[Result]]) -> Finding:
        took = {m: float(np.mean([r.budget["seconds"] for r in runs[m]])) for m in METHODS}
        slower = sum(took[m] > took[OURS] for m in OTHERS)
        return Finding(
            self.place,
            f"time: {', '.join(f'{label} {self.rows[m][1]}' for m, label in METHODS.items())} s",
            f"{', '.join(f'{label} {took[m]:.3f}' for m, label in METHODS.items())} s",
            verdict(slower == 4, slower >= 2),
            timed=True,
        )

    def _success(self, runs: Mapping[str, list[Result]]) -> Finding:
        share = {m: 100 * float(np.mean([r.found for r in runs[m]])) for m in METHODS}
        return Finding(
            self.place,
            f"success: {', '.join(f'{label} {self.rows[m][2]}' for m, label in METHODS.items())} %",
            f"runs with a path: {', '.join(f'{label} {share[m]:.0f}' for m, label in METHODS.items())} %",
            verdict(all(share[OURS] > share[m] for m in OTHERS), all(share[OURS] >= share[m] for m in OTHERS)),
        )

    def _stated(self) -> Iterator[Finding]:
        """Yield what the text says of the table, worked out again from the table."""
        length, time, success = (np.array([self.rows[m][k] for m in METHODS]) for k in range(3))
        names = ", ".join(OTHERS.values())
        readings = (
            ("length is less by", {"%": 1 - length[0] / length[1:], "% of IGA's": length[1:] / length[0] - 1}),
            ("time is less by", {"%": 1 - time[0] / time[1:], "% of IGA's": time[1:] / time[0] - 1}),
            ("success is more by", {"points": (success[0] - success[1:]) / 100, "%": success[0] / success[1:] - 1}),
        )
        for (what, reading), (low, high) in zip(readings, self.stated, strict=True):
            whole = [np.round(100 * by) for by in reading.values()]
            met = any(((by >= low) & (by <= high)).all() for by in whole)
            text = " or ".join(f"{', '.join(f'{100 * b:.1f}' for b in by)} {unit}" for unit, by in reading.items())
            yield Finding(
                f"section 4.3, {self.place}",
                f"{what} {low} % to {high} %",
                f"by the table itself, against {names}: {text}",
                verdict(met, all((by > 0).all() for by in whole)),
            )


@dataclass(frozen=True, kw_only=True)
class Table1(Table):
    """Random maps of 20 × 20."""

    source: ClassVar[str] = "Liu et al. 2024, section 4.3, table 1"
    number: ClassVar[int] = 1
    map: ClassVar[str] = "random-20:75"
    rows: ClassVar[dict[str, Row]] = {
        OURS: (28.0122, 4.203, 99.8),
        "ga-iga": (31.1782, 6.952, 93.5),
        "pso": (31.8821, 6.125, 92.4),
        "afsa": (30.3541, 6.224, 90.6),
        "gwo": (30.9512, 5.549, 94.5),
    }
    stated: ClassVar[tuple[Range, Range, Range]] = ((10, 14), (23, 38), (8, 10))


@dataclass(frozen=True, kw_only=True)
class Table2(Table):
    """Random maps of 40 × 40 with 15 % of obstacles."""

    source: ClassVar[str] = "Liu et al. 2024, section 4.3, table 2"
    number: ClassVar[int] = 2
    map: ClassVar[str] = "random-40:15%"
    rows: ClassVar[dict[str, Row]] = {
        OURS: (54.2362, 10.624, 99.7),
        "ga-iga": (68.8209, 16.257, 89.8),
        "pso": (59.6826, 14.354, 91.2),
        "afsa": (61.2684, 15.349, 90.1),
        "gwo": (60.8209, 15.756, 92.4),
    }
    stated: ClassVar[tuple[Range, Range, Range]] = ((10, 21), (28, 38), (8, 11))

    def examine(self, bench: Bench) -> Iterator[Finding]:
        yield from super().examine(bench)
        yield untestable(
            "table 2",
            f"mean length {self.rows[OURS][0]} on 40 × 40",
            f"no path between the centres of opposite corner cells is shorter than {39 * math.sqrt(2):.4f}; so start "
            "and goal are others, and they are not given",
        )


@dataclass(frozen=True, kw_only=True)
class SuccessRates(Claim):
    """Shares of 100 runs."""

    source: ClassVar[str] = "Liu et al. 2024, section 4.3, tables 1 and 2"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        printed = [row[2] for table in (Table1, Table2) for row in table.rows.values()]
        broken = [rate for rate in printed if rate != round(rate)]
        yield Finding(
            "tables 1, 2",
            "success rates of 100 runs",
            f"{len(broken)} of {len(printed)} are no whole per cent, such as {broken[0]}, and so no share of 100 runs; "
            "what is counted is not said",
            verdict(not broken),
        )
