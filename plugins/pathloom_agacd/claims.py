"""Sections 3 to 5: what the paper reports, to be measured again."""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from pathloom import Bench, Claim, Finding, PathProblem
from pathloom.claims import untestable, verdict
from pathloom.exact import any_angle_path
from pathloom.kernel.planner import Planner
from pathloom.paths.collision import Exact
from pathloom_agacd.collision import LinearTrial
from pathloom_agacd.comparing import (
    CONVERGENCE,
    FITNESS,
    LARGE,
    LENGTH,
    SAFETY,
    SAFETY_ALONG,
    SECONDS,
    SMALL,
    SMOOTHNESS,
    UNREFINED,
    Runs,
    averages,
    comparable,
    extent,
    extremes,
    only,
    overtaken,
    sampling_shares,
    spreads,
    tried,
    wins,
)
from pathloom_agacd.crossover import SinglePoint
from pathloom_agacd.mutation import SingleGene
from pathloom_agacd.planner import Agacd
from pathloom_agacd.probability import ExponentialFall
from pathloom_agacd.weighting import DelphiRatio

OTHERS = (
    "empty-20",
    "blocks-20:20%",
    "rooms-20:8",
    "maze-20:1",
    "empty-50",
    "blocks-50:20%",
    "rooms-50:8",
    "maze-50:1",
)

FIXED = Agacd(crossover=SinglePoint(rate=0.8), mutation=SingleGene(rate=0.3))
"""BGA's probabilities, the same for every individual in every generation."""
COMMON_NODE = Agacd(crossover=SinglePoint(join="common-node", probability=ExponentialFall(low=0.65, high=0.7)))
"""Children exchange tails at a cell that both parents visit: no long segments, until deletion makes them."""
COMMON_NODE_FIXED = Agacd(crossover=SinglePoint(join="common-node", rate=0.8), mutation=SingleGene(rate=0.3))
BOTH: Mapping[str, str] = {"AGACD": "agacd", "BGA": "bga"}
OTHER_READING = ", crossover.join = common-node"

MEAN_FITNESS = "mean fitness 0.2952, BGA 0.2072"
MEAN_CONVERGENCE = "converges at generation 60.95, BGA at 170.3"
PICTURE = "the map is printed as a picture only"


def on_small_maps(bench: Bench, planners: Mapping[str, str | Planner]) -> Runs:
    """Return runs of planners on maps of 20 × 20, whether they found a path or not."""
    # The three in the middle have both counts of obstacles, and spread like all ten.
    return tried(bench, planners, SMALL if bench.full else SMALL[4:7], bench.seeds(20, 3))


def on_large_maps(bench: Bench) -> Runs:
    """Return runs of AGACD, MPMGA and BGA on maps of 50 × 50, whether they found a path or not."""
    planners = {"AGACD": "agacd-50", "MPMGA": "mpmga", "BGA": "bga-50"}
    return tried(bench, planners, LARGE if bench.full else LARGE[1::2], bench.seeds(20, 4))


@dataclass(frozen=True, kw_only=True)
class Section1(Claim):
    """Feasible paths of high quality everywhere."""

    source: ClassVar[str] = "Hao et al. 2021, sections 1 and 5.3.5"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        seeds, found, gaps = bench.seeds(10, 1), 0, {}
        for name in (*SMALL[4:7], *LARGE[1::2], *(OTHERS if bench.full else OTHERS[::2])):
            problem = bench.problem(name)
            runs = bench.runs("agacd-50" if problem.grid.height == 50 else "agacd", problem, seeds)
            found += sum(r.found for r in runs)
            gaps[name] = [100 * (r.length / any_angle_path(problem)[0] - 1.0) for r in runs]
        every = np.concatenate(list(gaps.values()))
        worst = max(gaps, key=lambda name: max(gaps[name]))
        yield Finding(
            "section 1 (5)",
            "AGACD always finds feasible paths of high quality, whatever the size and the obstacles",
            f"in {found} of {len(every)} runs on {len(gaps)} maps (random, blocks, rooms, mazes, empty); median "
            f"{np.median(every):.1f} % above the shortest path, at most {every.max():.0f} %, on {worst}",
            verdict(found == len(every) and every.max() < 5.0, found == len(every) and np.median(every) < 5.0),
        )


@dataclass(frozen=True, kw_only=True)
class Section3(Claim):
    """The linear trial finds out whether a segment passes through an obstacle."""

    source: ClassVar[str] = "Hao et al. 2021, section 3, eqs. (3)-(6), fig. 2"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        missed, alarms = [], []
        for density in (10, 20, 30, 40):
            problems = [bench.problem(f"random-20:{density}%:s{k}") for k in range(bench.seeds(20, 2))]
            passes, free = np.concatenate([_verdicts(problem) for problem in problems], axis=1)
            missed.append(100 * float(passes[~free].mean()))
            alarms.append(100 * float((~passes[free]).mean()))
        yield Finding(
            "section 3",
            "on every grid map the trial tells whether a segment passes through an obstacle",
            f"wrong about {', '.join(f'{m:.2f}' for m in missed)} % of the blocked segments and about "
            f"{', '.join(f'{a:.1f}' for a in alarms)} % of the free ones, with 10, 20, 30, 40 % of obstacles",
            verdict(max(missed + alarms) == 0.0, max(missed) < 0.1 and max(alarms) < 5.0),
        )
        yield untestable("fig. 2", "of four segments only the last collides", PICTURE)


def _verdicts(problem: PathProblem) -> NDArray[np.bool_]:
    """Return what the trial and the exact test say of all segments between free cells 2 to 6 apart, (2, n)."""
    cells = np.argwhere(~problem.context.occupied)
    a, b = np.triu_indices(len(cells), 1)
    apart = np.abs(cells[a] - cells[b]).max(axis=1)
    near = (apart >= 2) & (apart <= 6)
    tests = (LinearTrial(verified=False), Exact())
    return np.stack([test.segments_free(cells[a[near]], cells[b[near]], problem) for test in tests])


@dataclass(frozen=True, kw_only=True)
class Section43(Claim):
    """Prior knowledge and random perturbation make a better first population, and keep it diverse."""

    source: ClassVar[str] = "Hao et al. 2021, sections 4.1 and 4.3"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        runs = comparable(on_small_maps(bench, BOTH))
        mean, distinct = (
            {name: float(np.mean([r.history[what][0] for r in of])) for name, of in runs.items()}
            for what in ("mean", "diversity")
        )
        yield Finding(
            "section 4.3",
            "the first population is better than a random one, and diverse",
            f"mean fitness AGACD {mean['AGACD']:.3f}, BGA {mean['BGA']:.3f}; "
            f"{100 * distinct['AGACD']:.1f} and {100 * distinct['BGA']:.1f} % of the paths differ from all others",
            verdict(mean["AGACD"] > mean["BGA"] and distinct["AGACD"] > 0.95),
        )


@dataclass(frozen=True, kw_only=True)
class Equation25(Claim):
    """The weights of the objectives."""

    source: ClassVar[str] = "Hao et al. 2021, section 4.4, eqs. (21)-(25)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problem, objectives = bench.problem("empty-5"), Agacd().objectives
        weights = DelphiRatio(ratios=(1.2, 1.4)).weights(objectives, problem).round(4)
        yield Finding(
            "eq. (25)",
            "ratios of 1.2 and 1.4 give the weights 0.4118, 0.3431, 0.2451",
            f"recomputed: {', '.join(f'{w:.4f}' for w in weights)}",
            verdict(tuple(weights) == (0.4118, 0.3431, 0.2451)),
        )


@dataclass(frozen=True, kw_only=True)
class Section46(Claim):
    """Probabilities that follow fitness and generation."""

    source: ClassVar[str] = "Hao et al. 2021, sections 1, 4.6, 4.7 and 5.2.3"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        runs = on_small_maps(bench, {"adaptive": "agacd", "fixed": FIXED})
        crossings, mutations = (
            [np.mean([r.budget["counts"].get(f"{what} failed", 0) for r in of]) for of in runs.values()]
            for what in ("crossover", "mutation")
        )
        yield Finding(
            "section 1 (4)",
            "adaptive operators reduce the number of invalid crossovers and mutations",
            f"{crossings[0]:.0f} and {mutations[0]:.0f} a run; {crossings[1]:.0f} and {mutations[1]:.0f} with fixed "
            "probabilities of 0.8 and 0.3",
            verdict(crossings[0] < crossings[1] and mutations[0] < mutations[1]),
        )
        other = on_small_maps(bench, {"adaptive": COMMON_NODE, "fixed": COMMON_NODE_FIXED})
        earlier = "adaptive operators make it converge earlier than fixed ones"
        better = "adaptive operators lead to better individuals than fixed ones"
        for reading, compared in (("", runs), (OTHER_READING, other)):
            yield averages(f"section 5.2.3{reading}", earlier, compared, CONVERGENCE)
            yield averages(f"section 6{reading}", better, compared, FITNESS)


@dataclass(frozen=True, kw_only=True)
class Section48(Claim):
    """Deletion of points at the end."""

    source: ClassVar[str] = "Hao et al. 2021, sections 4.8, 5.2.2 and 5.2.3, figs. 6 and 12, (a) and (b)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        small, large = comparable(on_small_maps(bench, {**BOTH, "common": COMMON_NODE})), on_large_maps(bench)
        for place, runs in (("fig. 6", small["AGACD"]), (f"fig. 6{OTHER_READING}", small["common"]),
                            ("fig. 12", large["AGACD"])):  # fmt: skip
            before, after = UNREFINED.values(runs), FITNESS.values(runs)
            better, worse = (int((change > 1e-12).sum()) for change in (after - before, before - after))
            yield Finding(
                place,
                "deletion (b) makes a better path of the best one (a)",
                f"mean fitness {before.mean():.3f} before, {after.mean():.3f} after; "
                f"better in {better} of {len(runs)} runs, worse in {worse}",
                verdict(worse == 0 and better >= 0.9 * len(runs), worse == 0 and better >= 0.1 * len(runs)),
            )
        bga, parts = UNREFINED.values(small["BGA"]).mean(), []
        for runs in (small["AGACD"], small["common"]):
            before, after = UNREFINED.values(runs).mean(), FITNESS.values(runs).mean()
            parts.append(100 * (after - before) / (after - bga))
        yield Finding(
            "section 5.2.3",
            "AGACD's individuals are better than BGA's because of deletion",
            f"of the lead in mean fitness deletion makes {parts[0]:.0f} %, with crossover.join = common-node "
            f"{parts[1]:.0f} %",
            verdict(parts[0] > 50.0),
        )
        common = {"AGACD": small["common"], "BGA": small["BGA"]}
        yield averages(f"table 8{OTHER_READING}", MEAN_FITNESS, common, FITNESS)
        yield averages(f"table 8, fig. 7{OTHER_READING}", MEAN_CONVERGENCE, common, CONVERGENCE)


@dataclass(frozen=True, kw_only=True)
class Figure6(Claim):
    """20 × 20: the paths."""

    source: ClassVar[str] = "Hao et al. 2021, section 5.2.2, fig. 6"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        tries = on_small_maps(bench, BOTH)
        runs, total = comparable(tries), len(tries["AGACD"])
        found = len(runs["AGACD"])
        yield Finding(
            "fig. 6", "both algorithms find paths", f"both in {found} of {total} runs", verdict(found == total)
        )
        yield averages("fig. 6", "AGACD's path is shorter", runs, LENGTH)
        yield averages("fig. 6", "AGACD's path is smoother", runs, SMOOTHNESS)
        less_safe, swapped = "AGACD's path is slightly less safe", only(runs, "BGA", "AGACD")
        yield averages("fig. 6", less_safe, swapped, SAFETY)
        yield averages("fig. 6, safety.of = cells", less_safe, swapped, SAFETY_ALONG)


@dataclass(frozen=True, kw_only=True)
class Table7(Claim):
    """20 × 20: the time that the first population takes."""

    source: ClassVar[str] = "Hao et al. 2021, section 5.2.4, table 7"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        shares, measured = sampling_shares(comparable(on_small_maps(bench, BOTH)))
        yield Finding(
            "table 7",
            "the first population takes 0.0414 of 1.63 s, 2.54 %, BGA's 0.3089 of 1.98 s, 15.60 %",
            measured,
            verdict(False, shares["AGACD"] < shares["BGA"]),
            timed=True,
        )


@dataclass(frozen=True, kw_only=True)
class Table8(Claim):
    """20 × 20: AGACD against BGA."""

    source: ClassVar[str] = "Hao et al. 2021, sections 5.2.3 and 5.2.5, tables 8 and 9, figs. 7 to 10"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        runs = comparable(on_small_maps(bench, BOTH))
        late = float((CONVERGENCE.values(runs["BGA"]) > 200).mean())
        yield averages("table 8", MEAN_FITNESS, runs, FITNESS, extent(runs))
        yield averages("table 8, fig. 7", MEAN_CONVERGENCE, runs, CONVERGENCE, overtaken(runs, "BGA"))
        yield averages("table 8", "1.5125 s, BGA 1.9508 s", runs, SECONDS)
        yield spreads("table 9", "standard deviation of fitness 0.0798, BGA slightly less, 0.0639", runs, FITNESS,
                      lambda sd: sd[1] < sd[0])  # fmt: skip
        yield spreads("table 9", "standard deviation of convergence 21.6, BGA much more, 100.8", runs, CONVERGENCE,
                      lambda sd: sd[0] < 0.75 * sd[1])  # fmt: skip
        yield spreads("table 9", "standard deviation of time 0.1834 s, BGA more, 0.4922 s", runs, SECONDS,
                      lambda sd: sd[0] < sd[1])  # fmt: skip
        yield wins("fig. 8", "fitter than BGA in 18 of 20 runs", runs, FITNESS, {"BGA": 18 / 20})
        yield extremes("fig. 8", "best fitness 0.4392, BGA 0.3431; the worst is better as well", runs, "BGA")
        yield wins("fig. 9", "earlier than BGA in almost every run", runs, CONVERGENCE, {"BGA": 0.9})
        yield Finding("fig. 9", "BGA converges after generation 200 in half of its runs",
                      f"in {100 * late:.0f} % of them", verdict(late >= 0.5))  # fmt: skip
        yield wins("fig. 10", "faster than BGA in 19 of 20 runs", runs, SECONDS, {"BGA": 19 / 20})


@dataclass(frozen=True, kw_only=True)
class Figure12(Claim):
    """50 × 50: the paths."""

    source: ClassVar[str] = "Hao et al. 2021, section 5.3.2, fig. 12"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        tries = on_large_maps(bench)
        runs, found = comparable(tries), {name: sum(r.found for r in of) for name, of in tries.items()}
        failed = Counter(together[0].problem["map"] for together in zip(*tries.values(), strict=True)
                         if not all(r.found for r in together))  # fmt: skip
        yield Finding(
            "fig. 12",
            "all three algorithms find paths",
            f"{', '.join(f'{name} {n}' for name, n in found.items())} of {len(tries['AGACD'])} runs; "
            f"sampling fails on {', '.join(f'{name} ({n} times)' for name, n in failed.items())}",
            verdict(min(found.values()) == len(tries["AGACD"])),
        )
        yield averages("fig. 12", "AGACD's path is the shortest", runs, LENGTH)
        yield averages("fig. 12", "AGACD's path is the smoothest", runs, SMOOTHNESS)
        for place, quantity in (("fig. 12", SAFETY), ("fig. 12, safety.of = cells", SAFETY_ALONG)):
            yield averages(place, "AGACD's path is safer than MPMGA's", only(runs, "AGACD", "MPMGA"), quantity)
            yield averages(place, "AGACD's path is less safe than BGA's", only(runs, "BGA", "AGACD"), quantity)


@dataclass(frozen=True, kw_only=True)
class Table11(Claim):
    """50 × 50: the time that the first population takes."""

    source: ClassVar[str] = "Hao et al. 2021, sections 4.3 and 5.3.4, tables 7 and 11"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        printed = {  # first population, evolution, total, share
            (0.0414, 1.5886, 1.63, 2.54), (0.3089, 1.6711, 1.98, 15.60), (0.9777, 8.664, 9.6417, 10.14),
            (53.6721, 9.0143, 62.6864, 85.62), (43.3714, 9.3021, 52.6735, 82.34),
        }  # fmt: skip
        right = sum(
            abs(a + b - total) < 5e-5 and abs(100 * a / total - share) < 0.006 for a, b, total, share in printed
        )
        yield Finding(
            "tables 7, 11",
            "sums and shares of the times",
            f"recomputed: {right} of {len(printed)} rows right",
            verdict(right == len(printed)),
        )
        large, small = comparable(on_large_maps(bench)), comparable(on_small_maps(bench, BOTH))
        (shares, measured), (before, _) = sampling_shares(large), sampling_shares(small)
        yield Finding(
            "table 11",
            "the first population takes 0.9777 of 9.64 s, 10.14 %, MPMGA's 53.67 of 62.69 s, 85.62 %, BGA's 43.37 of "
            "52.67 s, 82.34 %",
            measured,
            verdict(False, shares["AGACD"] < min(shares["MPMGA"], shares["BGA"])),
            timed=True,
        )
        yield Finding("section 4.3", "on 50×50 the first population takes 81.32 % of the time of MPMGA",
                      f"{100 * shares['MPMGA']:.1f} %",
                      verdict(shares["MPMGA"] > 0.75, shares["MPMGA"] > 0.5), timed=True)  # fmt: skip
        times = {
            name: float(np.mean(SECONDS.values(large[name])) / np.mean(SECONDS.values(small[name]))) for name in small
        }
        yield Finding(
            "section 5.3.4",
            "from 20×20 to 50×50 the time of BGA grows sharply, 26.6 times, the share of its first population from "
            "15.60 to 82.34 %; the time of AGACD slightly, 5.9 times",
            f"BGA {times['BGA']:.1f} times, from {100 * before['BGA']:.1f} to {100 * shares['BGA']:.1f} %; "
            f"AGACD {times['AGACD']:.1f} times",
            verdict(False, times["BGA"] > times["AGACD"] and shares["BGA"] > before["BGA"]),
            timed=True,
        )


@dataclass(frozen=True, kw_only=True)
class Table12(Claim):
    """50 × 50: AGACD against MPMGA and BGA."""

    source: ClassVar[str] = "Hao et al. 2021, sections 5.3.3 and 5.3.5, tables 12 and 13, figs. 13 to 16"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        runs = comparable(on_large_maps(bench))
        others = only(runs, "MPMGA", "BGA")
        mean = {name: float(CONVERGENCE.values(of).mean()) for name, of in runs.items()}
        yield averages("table 12", "mean fitness 0.5197, MPMGA 0.4356, BGA 0.3065: AGACD best", runs, FITNESS,
                       extent(runs))  # fmt: skip
        yield averages("table 12", "MPMGA in between, 0.4356 against 0.3065", others, FITNESS)
        yield averages("table 12", "converges at generation 111.9, MPMGA 217.25, BGA 327.2: AGACD first", runs,
                       CONVERGENCE, overtaken(runs, "MPMGA"), overtaken(runs, "BGA"))  # fmt: skip
        yield averages("table 12", "MPMGA before BGA, 217.25 against 327.2", others, CONVERGENCE)
        yield Finding("fig. 13", "AGACD and MPMGA converge almost equally fast",
                      f"at generation {mean['AGACD']:.0f} and {mean['MPMGA']:.0f}",
                      verdict(abs(mean["AGACD"] - mean["MPMGA"]) < 0.1 * mean["MPMGA"],
                              abs(mean["AGACD"] - mean["MPMGA"]) < 0.5 * mean["MPMGA"]))  # fmt: skip
        yield averages("table 12", "10.16 s, MPMGA 55.69 s, BGA 49.13 s: AGACD fastest", runs, SECONDS)
        yield averages("section 5.3.5", "MPMGA takes even longer than BGA", only(runs, "BGA", "MPMGA"), SECONDS)
        yield spreads("table 13", "standard deviation of fitness 0.0426, BGA less, 0.0208", only(runs, "AGACD", "BGA"),
                      FITNESS, lambda sd: sd[1] < sd[0])  # fmt: skip
        yield spreads("table 13", "standard deviation of fitness 0.0426, MPMGA more, 0.0514",
                      only(runs, "AGACD", "MPMGA"), FITNESS, lambda sd: sd[0] < sd[1])  # fmt: skip
        yield spreads("table 13", "standard deviation of convergence 48.5, less than MPMGA's, 62.4, and BGA's, 84.6",
                      runs, CONVERGENCE, lambda sd: sd[0] < min(sd[1:]))  # fmt: skip
        yield spreads("table 13", "standard deviation of time 1.17 s, less than MPMGA's, 8.40 s, and BGA's, 5.90 s",
                      runs, SECONDS, lambda sd: sd[0] < min(sd[1:]))  # fmt: skip
        yield wins("fig. 14", "fitter than BGA in 20 of 20 runs, than MPMGA in 17", runs, FITNESS,
                   {"BGA": 1.0, "MPMGA": 17 / 20})  # fmt: skip
        yield extremes("fig. 14", "best fitness 0.5634, BGA 0.3376; the worst is better as well", runs, "BGA")
        yield wins("fig. 15", "earlier than BGA and MPMGA in almost every run", runs, CONVERGENCE,
                   {"BGA": 0.9, "MPMGA": 0.9})  # fmt: skip
        yield wins("fig. 16", "faster than BGA and MPMGA in 20 of 20 runs", runs, SECONDS, {"BGA": 1.0, "MPMGA": 1.0})
