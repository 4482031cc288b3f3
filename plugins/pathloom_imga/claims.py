"""Section 5: what the paper reports, to be measured again."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Bench, Claim, Finding
from pathloom.claims import NEEDS_DATA, smaller, untestable, verdict

ENVIRONMENT_4 = "ga_grids/ga_smooth_20x20.csv"
"""The map of fig. 8, recovered: count of obstacles, optimum and the paper's result coincide."""
ENDS: dict[str, Any] = {"start": "top-left", "goal": "bottom-right"}


@dataclass(frozen=True, kw_only=True)
class Table1(Claim):
    """Deletion shortens the path and saves turns."""

    source: ClassVar[str] = "Li et al. 2021, section 5.1, table 1"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        environments = ((10, 40, "13.1356 to 13.0908", "3 to 3"), (15, 90, "20.3848 to 19.9390", "3 to 2"),
                        (20, 160, "28.5724 to 28.4733", "11 to 8"))  # fmt: skip
        for size, obstacles, lengths, turns in environments:
            gains, fewer, longer = [], 0, 0
            maps = bench.seeds(10, 4)
            for k in range(maps):
                problem = bench.problem(f"random-{size}:{obstacles}:s{k}")
                for result in bench.runs("imga", problem, 3):
                    before = bench.unrefined(result)
                    gains.append(1 - result.length / before["length"])
                    fewer += before["turns"] - result.metrics["turns"]
                    longer += result.length > before["length"] + 1e-9 or before["turns"] < result.metrics["turns"]
            yield Finding(
                f"table 1, {size}×{size}, {obstacles} obstacles",
                f"deletion takes the length from {lengths}, turns from {turns}",
                f"{100 * np.mean(gains):.1f} % shorter and {fewer / len(gains):.1f} turns fewer on average, longer or "
                f"more turns in {longer} of {len(gains)} ({maps} random maps × 3 seeds)",
                verdict(False, longer == 0 and np.mean(gains) > 0),
            )


@dataclass(frozen=True, kw_only=True)
class Table2(Claim):
    """The more generations, the more often the best path is found."""

    source: ClassVar[str] = "Li et al. 2021, section 5.1, table 2, fig. 7(b)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        seeds, limits = bench.seeds(30, 10), (20, 50, 100, 200)
        problems = [bench.problem(f"random-20:160:s{k}") for k in range(bench.seeds(5, 2))]
        found, seconds, settled = np.zeros(4), np.zeros(4), []
        for problem in problems:
            by_limit = []
            for limit in limits:
                stop = [{"use": "max-generations", "limit": limit}]
                by_limit.append(bench.runs({"use": "imga", "termination": stop}, problem, seeds))
            best = min(r.length for runs in by_limit for r in runs)
            found += [sum(r.length < best + 1e-9 for r in runs) for runs in by_limit]
            seconds += [np.median([r.budget["seconds"] for r in runs]) for runs in by_limit]
            settled += [_settled(r.history["best"]) for r in by_limit[1]]
        share = found / (seeds * len(problems))
        yield Finding(
            "table 2",
            "best path found in 0, 2, 4, 5 of 10 runs with 20, 50, 100, 200 generations",
            f"in {', '.join(f'{10 * s:.1f}' for s in share)} of 10 "
            f"(random-20:160, {len(problems)} maps × {seeds} seeds)",
            verdict(False, bool(share[-1] > share[0] and (np.diff(share) >= -0.05).all())),
        )
        yield Finding(
            "table 2",
            "0.598, 0.714, 0.803, 0.983 s with 20, 50, 100, 200 generations",
            f"{', '.join(f'{s / len(problems):.4f}' for s in seconds)} s (medians of the same runs)",
            verdict(False, bool((np.diff(seconds) > 0).all())),
            timed=True,
        )
        median = float(np.median(settled))
        yield Finding(
            "fig. 7(b)",
            "stable from about the 10th generation",
            f"within 1 % of the final best fitness from generation {median:.0f} (median of {len(settled)} runs)",
            verdict(median <= 12, median <= 25),
        )


def _settled(best: list[float]) -> int:
    return next(k for k, value in enumerate(best) if value >= 0.99 * best[-1])


@dataclass(frozen=True, kw_only=True)
class Table3(Claim):
    """Environment 4: IMGA against a plain and an improved genetic algorithm."""

    source: ClassVar[str] = "Li et al. 2021, section 5.2, table 3"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        said = {
            "imga": "IMGA: 29.6896, 7 turns, 3 tangencies, no passage between two obstacles",
            "ga-imga": "GA: 35.7990, 20 turns, 10 tangencies, 2 passages",
            "ga-lit37": "GA of literature [37]: 29.7990, 13 turns, 8 tangencies, 1 passage",
        }
        problem = bench.recovered(ENVIRONMENT_4, **ENDS)
        if problem is None:
            yield from (untestable("table 3", says, NEEDS_DATA) for says in said.values())
            yield untestable("section 5.2", "17 % shorter than GA", NEEDS_DATA)
            return
        seeds, means = bench.seeds(30, 10), {}
        for name, says in said.items():
            runs = sorted(bench.runs(name, problem, seeds), key=lambda r: r.length)
            means[name] = [r.length for r in bench.runs(name, problem, seeds)]
            best = {k: runs[0].metrics[k] for k in ("turns", "touches", "squeezes")}
            measured = (
                f"best of {seeds}: {runs[0].length:.4f}, {best['turns']} turns, {best['touches']} touches, "
                f"squeezes {best['squeezes']}; median {np.median(means[name]):.4f}"
            )
            if name == "imga":
                exact = (round(runs[0].length, 4), *best.values()) == (29.6896, 7, 3, 0)
                result = verdict(exact, runs[0].length < 29.6897)
            elif name == "ga-imga":
                result = verdict(False, min(means[name]) > max(means["imga"]) and best["turns"] > 7)
            else:  # 29.7990 = 10 + 14 √2 is shorter than any 8-connected path of this map, 30.9706
                lead = smaller(means["imga"], means[name])
                measured += f"; IMGA shorter in {lead}"
                result = verdict(False, lead.p < 0.05)
            yield Finding("table 3", says, measured, result)
        gain = 1 - np.mean(means["imga"]) / np.mean(means["ga-imga"])
        yield Finding(
            "section 5.2", "17 % shorter than GA", f"{100 * gain:.1f} % (means of {seeds})",
            verdict(abs(gain - 0.17) < 0.05, gain > 0),
        )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Table4(Claim):
    """Environment 5: IMGA against a genetic algorithm on Bézier curves."""

    source: ClassVar[str] = "Li et al. 2021, section 5.2, table 4"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        # The map is printed as a picture only and BCA is not described: other maps, and a reconstruction.
        maps, seeds = bench.seeds(5, 2), bench.seeds(6, 3)
        problems = [bench.problem(f"random-20:75:s{k}") for k in range(maps)]
        ours, curves = ([r for p in problems for r in bench.runs(name, p, seeds)] for name in ("imga", "bezier-ga"))
        both = [(a, b) for a, b in zip(ours, curves, strict=True) if b.found]
        lengths = np.array([(a.length, b.metrics["polyline_length"]) for a, b in both])
        seconds = np.median([[r.budget["seconds"] for r in runs] for runs in (ours, curves)], axis=1)
        lead = smaller(lengths[:, 0].tolist(), lengths[:, 1].tolist())
        yield Finding(
            "table 4",
            "IMGA 27.8721, BCA 29.9416 (means of 30 runs)",
            f"{lengths[:, 0].mean():.4f}, bezier-ga {lengths[:, 1].mean():.4f} where it found a curve, {len(both)} of "
            f"{len(curves)} runs (random-20:75, {maps} maps × {seeds} seeds); IMGA shorter in {lead}",
            verdict(False, lead.p < 0.05),
        )
        yield Finding(
            "table 4",
            "IMGA 0.7016 s, BCA 136.4794 s, five thousandths",
            f"{seconds[0]:.4f} s, bezier-ga {seconds[1]:.3f} s, {1000 * seconds[0] / seconds[1]:.0f} thousandths "
            "(medians of the same runs)",
            verdict(seconds[0] < 0.01 * seconds[1], seconds[0] < seconds[1]),
            timed=True,
        )
