"""Sections 4 and 5.6: what the paper reports of S-RRT and of HGA-ACO, to be measured again."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Bench, Claim, Finding, Result
from pathloom.claims import smaller, untestable, verdict
from pathloom.exact import octile_path

PRINTED: dict[str, Any] = {"heuristic": "hga-aco/edge-length"}
"""Eq. (30) to the letter."""
HYBRID, ANTS, GENES = {"use": "hga-aco"}, {"use": "aco-hga-aco"}, {"use": "ga-hga-aco"}


@dataclass(frozen=True, kw_only=True)
class Table3(Claim):
    """HGA-ACO against its parts: shorter paths, after fewer iterations, in less time."""

    source: ClassVar[str] = "Song et al. 2021, section 5.6, table 3, fig. 11"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problems = [bench.problem(f"random-20:75:s{k}") for k in range(bench.seeds(10, 4))]
        seeds = bench.seeds(20, 5)
        where = f"random-20:75, {len(problems)} maps × {seeds} seeds"

        def runs(planner: dict[str, Any]) -> list[Result]:
            return [result for problem in problems for result in bench.runs(planner, problem, seeds)]

        hybrid, ants, genes = (runs(planner) for planner in (HYBRID, ANTS, GENES))
        best = np.repeat([octile_path(problem)[0] for problem in problems], seeds)
        says = "28.6274, 29.7990, 29.2132 (HGA-ACO) against {}, never longer"
        yield _shorter(says.format("29.4558, 31.4558, 29.2132 (ACO)"), hybrid, ants, best, where)
        yield _shorter(says.format("30.6274, 30.2132, 30.3848 (GA)"), hybrid, genes, best, where)
        hybrid_as_printed, ants_as_printed = runs({**HYBRID, "colony": PRINTED}), runs({**ANTS, **PRINTED})
        yield _shorter(
            says.format("29.4558, 31.4558, 29.2132 (ACO)"),
            hybrid_as_printed,
            ants_as_printed,
            best,
            f"{where}, eq. (30) as printed",
            "eq. (30)",
        )
        yield untestable(
            "table 3",
            "GA, scenario 2: 30.2132",
            "9 + 15 √2, an odd number of steps along the axes, cannot lead from corner to corner as 29.7990 does",
        )
        fewer = smaller([_settled(r, 101) for r in hybrid], [_settled(r, 0) for r in ants])
        medians = [float(np.median([_settled(r, first) for r in rs])) for rs, first in ((hybrid, 101), (ants, 0))]
        yield Finding(
            "table 3, fig. 11",
            "best path in iteration 10, 2, 20 (HGA-ACO) against 65, 68, 50 (ACO)",
            f"medians {medians[0]:.0f} and {medians[1]:.0f}, fewer in {fewer}; {where}",
            verdict(False, fewer.p < 0.05),
        )
        times = [[r.budget["seconds"] for r in rs] for rs in (hybrid, ants)]
        yield Finding(
            "table 3",
            "1.36, 1.49, 1.42 s (HGA-ACO) against 14.76, 15.27, 14.33 s (ACO)",
            f"medians {1000 * np.median(times[0]):.0f} and {1000 * np.median(times[1]):.0f} ms, "
            f"less in {smaller(*times)}; {where}",
            verdict(False, smaller(*times).p < 0.05),
            timed=True,
        )


def _settled(result: Result, first: int) -> int:
    """Return after how many generations, counted from one, the best of them and all that follow it was found."""
    return int(np.argmax(result.history["generation_best"][first:]))


def _shorter(
    says: str, ours: list[Result], theirs: list[Result], optimum: np.ndarray, where: str, place: str = "table 3"
) -> Finding:
    first, second = ([round(r.length, 9) for r in rs] for rs in (ours, theirs))
    gaps = [float(np.mean(100 * (np.array(found) / optimum - 1))) for found in (first, second)]
    lead = smaller(first, second)
    longer = lead.pairs - lead.wins - lead.ties
    return Finding(
        place,
        says,
        f"{gaps[0]:.1f} and {gaps[1]:.1f} % above the optimum, shorter in {lead}; longer in {longer}; {where}",
        verdict(False, longer <= lead.wins),
    )


@dataclass(frozen=True, kw_only=True)
class Table2(Claim):
    """S-RRT against RRT: shorter paths of fewer nodes, for more time."""

    source: ClassVar[str] = "Song et al. 2021, section 4, table 2"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        said = (
            ("30.27, 4.25 nodes (S-RRT) against 36.50, 20.5 nodes (RRT)", "blocks-20:10%"),
            ("30.47, 3.35 nodes (S-RRT) against 35.33, 20.05 nodes (RRT)", "blocks-20:20%"),
            ("30.90, 4.35 nodes (S-RRT) against 36.64, 20.70 nodes (RRT)", "blocks-20:20%:s1"),
        )
        seconds: list[list[float]] = [[], []]
        for scenario, (says, name) in enumerate(said, 1):
            problem, seeds = bench.problem(name, corners="strict"), bench.seeds(100, 20)
            smooth, plain = (bench.runs(planner, problem, seeds) for planner in ("s-rrt", "rrt"))
            lengths = [[r.length for r in runs] for runs in (smooth, plain)]
            nodes = [float(np.mean([r.metrics["nodes"] for r in runs])) for runs in (smooth, plain)]
            for of, runs in zip(seconds, (smooth, plain), strict=True):
                of += [r.budget["seconds"] for r in runs]
            lead, gain = smaller(*lengths), 1.0 - np.mean(lengths[0]) / np.mean(lengths[1])
            yield Finding(
                f"table 2, scenario {scenario}",
                says,
                f"{np.mean(lengths[0]):.2f}, {nodes[0]:.1f} nodes against "
                f"{np.mean(lengths[1]):.2f}, {nodes[1]:.1f} nodes "
                f"({100 * gain:.0f} % shorter, in {lead}; {name}, {seeds} seeds)",
                verdict(False, lead.p < 0.05 and nodes[0] < nodes[1]),
            )
        ratio = float(np.median(seconds[0]) / np.median(seconds[1]))
        yield Finding(
            "table 2",
            "1.78, 2.11, 2.23 s (S-RRT) against 1.46, 1.71, 1.86 s (RRT), a fifth more",
            f"medians {1000 * np.median(seconds[0]):.2f} and {1000 * np.median(seconds[1]):.2f} ms, "
            f"{ratio:.2f} times as long",
            verdict(1.1 < ratio < 1.4, ratio > 1.0),
            timed=True,
        )
