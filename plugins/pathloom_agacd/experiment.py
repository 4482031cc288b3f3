"""Section 5.2.1: the designed experiment that set the parameters, recomputed and run again."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from pathloom import Bench, Claim, Finding
from pathloom.claims import untestable, verdict
from pathloom_agacd.comparing import FITNESS, SMALL, tried
from pathloom_agacd.crossover import SinglePoint
from pathloom_agacd.mutation import SingleGene
from pathloom_agacd.planner import Agacd
from pathloom_agacd.probability import ExponentialFall, ExponentialRise
from pathloom_agacd.taguchi import aliases, correlations, main_effects

DESIGN = np.array(
    [
        [-1, -1, -1, -1, 0],
        [-1, 0, 0, 0, 1],
        [-1, 1, 1, 1, -1],
        [0, -1, 0, 1, 1],
        [0, 0, 1, -1, -1],
        [0, 1, -1, 0, 0],
        [1, -1, 1, 0, -1],
        [1, 0, -1, 1, 0],
        [1, 1, 0, -1, 1],
    ]
)
"""Table 4: levels of population, pc_low, pc_high, pm_low and pm_high."""
TRIALS = np.array(
    [
        [0.1386, 0.2398, 0.2551, 0.2132, 0.2398],
        [0.2398, 0.2398, 0.2336, 0.2286, 0.2169],
        [0.2582, 0.2337, 0.2378, 0.2337, 0.2132],
        [0.2398, 0.2398, 0.2336, 0.2804, 0.4392],
        [0.2398, 0.2398, 0.1364, 0.2398, 0.1364],
        [0.2857, 0.4392, 0.2112, 0.2400, 0.2398],
        [0.2219, 0.2857, 0.1386, 0.2398, 0.2378],
        [0.2398, 0.2378, 0.2398, 0.2114, 0.2398],
        [0.2398, 0.2398, 0.2378, 0.2453, 0.4692],
    ]
)
"""Table 5: fitness in five runs of each."""
MEANS = (0.2173, 0.2317, 0.2353, 0.2866, 0.1984, 0.2832, 0.2248, 0.2337, 0.2864)
COEFFICIENTS = (0.00673, 0.00847, -0.00841, 0.00594, 0.01624)
CHOSEN = (1, 1, -1, 1, 1)
CONFIRMED = np.array([0.3077, 0.2398, 0.2398, 0.4392, 0.3077])
MIDDLE, STEP = np.array([50, 0.60, 0.75, 0.10, 0.25]), np.array([10, 0.05, 0.05, 0.05, 0.05])
"""Table 3: the parameters at level 0, and from level to level."""


@dataclass(frozen=True, kw_only=True)
class Table5(Claim):
    """The designed experiment: what follows from the paper's own figures."""

    source: ClassVar[str] = "Hao et al. 2021, section 5.2.1, tables 3 to 5, eqs. (30) and (31)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        printed, fitted = main_effects(DESIGN, TRIALS, "paper"), main_effects(DESIGN, TRIALS)
        means = TRIALS.mean(axis=1)
        yield Finding(
            "tables 3, 4",
            "a Taguchi table of five factors with three levels each",
            f"nine rows have room for four: the level of F3 gives that of F5, correlation "
            f"{_listed([correlations(DESIGN)[2, 4]], 1)}",
            verdict(not aliases(DESIGN)),
        )
        yield Finding(
            "table 5",
            f"means {_listed(MEANS, 4)}, of all 0.24416",
            f"recomputed: {_listed(means, 4)}, of all {printed.mean:.5f}",
            verdict(np.abs(means - MEANS).max() < 5.1e-5 and abs(printed.mean - 0.24416) < 5.1e-6),
        )
        yield Finding(
            "table 5, eq. (31)",
            f"coefficients {_listed(COEFFICIENTS, 5)}",
            f"sums divided by the nine rows: {_listed(printed.slopes, 5)} (0.00673 of rounded means)",
            verdict(np.abs(printed.slopes - COEFFICIENTS).max() < 1.1e-5),
        )
        largest = np.abs(fitted.slopes / fitted.errors).max()
        yield Finding(
            "eqs. (30), (31)",
            "(31) predicts the fitness from the parameters",
            f"by least squares the coefficients are {_listed(fitted.slopes, 5)}, as only six rows of nine count for a "
            f"factor; none is more than {largest:.1f} standard errors from 0",
            verdict(np.abs(printed.slopes - fitted.slopes).max() < 1e-4, largest > 2.0),
        )
        yield Finding(
            "section 5.2.1",
            "(31) is largest at (1, 1, −1, 1, 1), where it is 0.28995",
            f"at ({_listed(printed.best, 0)}), where it is {printed.predict(CHOSEN):.5f}; by least squares "
            f"{fitted.predict(CHOSEN):.5f}",
            verdict(tuple(printed.best) == CHOSEN and abs(printed.predict(CHOSEN) - 0.28995) < 1.1e-5),
        )
        yield Finding(
            "section 5.2.1",
            "pc_high is best at its lowest level",
            f"by least squares its coefficient is {_listed(fitted.slopes[2:3], 4)} ± {fitted.errors[2]:.4f}, "
            "once pm_high, of which it is the other name, has one",
            verdict(fitted.slopes[2] < -2 * fitted.errors[2], fitted.slopes[2] < -fitted.errors[2]),
        )
        error = CONFIRMED.std(ddof=1) / np.sqrt(len(CONFIRMED))
        yield Finding(
            "section 5.2.1",
            "five more runs average 0.30684, more than predicted",
            f"recomputed: {CONFIRMED.mean():.5f} ± {error:.3f}, without the best of the five "
            f"{np.sort(CONFIRMED)[:-1].mean():.5f}",
            verdict(abs(CONFIRMED.mean() - 0.30684) < 5.1e-6),
        )


@dataclass(frozen=True, kw_only=True)
class Table6(Claim):
    """The designed experiment, run again."""

    source: ClassVar[str] = "Hao et al. 2021, sections 5.2.1 and 5.3.1, tables 4, 6 and 10"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        maps, seeds = SMALL if bench.full else SMALL[:1], bench.seeds(20, 2)
        settings = {str(row): planner_at(levels) for row, levels in enumerate((*DESIGN, CHOSEN))}
        runs = tried(bench, settings, maps, seeds)
        fitness = np.array([FITNESS.values(of) for of in runs.values()])
        means = fitness.mean(axis=1)
        by_map = fitness.reshape(len(settings), len(maps), seeds)
        without_maps = (by_map - by_map.mean(axis=(0, 2), keepdims=True)).reshape(fitness.shape)
        effects = main_effects(DESIGN, without_maps[:-1])
        yield Finding(
            "section 5.2.1, table 6",
            "(1, 1, −1, 1, 1) is the best setting",
            f"place {1 + (means > means[-1]).sum()} of ten with {means[-1]:.3f}, the nine of table 4 "
            f"{means[:-1].min():.3f} to {means[:-1].max():.3f} ({fitness.shape[1]} runs each); "
            f"coefficients over standard errors {_listed(effects.slopes / effects.errors, 1)}",
            verdict(means[-1] == means.max()),
        )
        yield untestable(
            "tables 6, 10",
            "BGA's parameters, and all on 50×50, come from such experiments",
            "neither designs nor trials are printed",
        )


def planner_at(levels: ArrayLike) -> Agacd:
    """Return the planner with the parameters of table 3 at these levels (5,)."""
    population, pc_low, pc_high, pm_low, pm_high = (MIDDLE + STEP * np.asarray(levels)).round(2).tolist()
    return Agacd(
        population=round(population),
        crossover=SinglePoint(probability=ExponentialFall(low=pc_low, high=pc_high)),
        mutation=SingleGene(probability=ExponentialRise(low=pm_low, high=pm_high)),
    )


def _listed(numbers: Any, digits: int) -> str:
    return ", ".join(f"{n:.{digits}f}".replace("-", "−") for n in numbers)
