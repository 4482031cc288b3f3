"""Multi-population genetic algorithms."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from pathloom import (
    Control,
    Count,
    Crossover,
    Deme,
    Fidelity,
    Migration,
    Mutation,
    Pairing,
    Problem,
    Sampling,
    Selection,
    State,
    Termination,
)
from pathloom.kernel.selection import RandomPairs
from pathloom.kernel.termination import MaxGenerations, Stagnation
from pathloom_baselines.control import ByPopulation
from pathloom_baselines.crossover import BestMeeting
from pathloom_baselines.migration import RingMigration
from pathloom_baselines.mutation import TwoPoint
from pathloom_baselines.planners import AGACD, Bga
from pathloom_baselines.sampling import RandomPerRow
from pathloom_baselines.selection import KeepAll


@dataclass(frozen=True, kw_only=True)
class DividedPopulation(Bga):
    """Several populations of equal size, into which one large one is divided at random."""

    def start(self, problem: Problem, rng: np.random.Generator) -> State:
        populations = self.migration.demes if self.migration else 1
        undivided = replace(self, population=populations * self.population, migration=None)
        state = Bga.start(undivided, problem, rng)
        deme = state.demes[0]
        parts = np.array_split(rng.permutation(len(deme)), populations)
        demes = tuple(Deme(deme.population[part], deme.values[part], deme.fitness[part]) for part in parts)
        return replace(state, demes=demes, random=rng.bit_generator.state)


@dataclass(frozen=True, kw_only=True)
class Mpmga(DividedPopulation):
    """MPMGA, the multi-population migration genetic algorithm, as far as it can be known from outside."""

    name: ClassVar[str] = "mpmga"
    reference: ClassVar[str] = (
        "K. Hao, J. Zhao, K. Yu, C. Li, C. Wang (2020), Path Planning of Mobile Robots Based on a Multi-Population "
        f"Migration Genetic Algorithm, Sensors 20(20), 5873, doi:10.3390/s20205873; parameters: {AGACD}, table 10"
    )
    bibtex: ClassVar[str] = """\
@article{hao2020mpmga,
  author  = {Hao, Kun and Zhao, Jiale and Yu, Kaicheng and Li, Cheng and Wang, Chuanqi},
  title   = {Path Planning of Mobile Robots Based on a Multi-Population Migration Genetic Algorithm},
  journal = {Sensors},
  volume  = {20},
  number  = {20},
  year    = {2020},
  pages   = {5873},
  doi     = {10.3390/s20205873}
}
"""
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Only the abstract and the introduction were at hand, and parameters from a later paper of the same group: "
        "three populations of 15, 500 generations, a high and a low value of each probability, an accuracy coefficient "
        "of 1, an initial temperature of 1 and its decay of 0.9.",
        "Stated: one population is divided at random into equal small ones, migration takes the place of selection, "
        "crossover and mutation are improved. All that follows is ours.",
        "The populations have different probabilities, 0.8 and 0.1, 0.3 and 0.6, 0.8 and 0.6; control.probabilities "
        "offers the other reading, that high and low are the bounds of adaptive ones.",
        "Crossover tries up to 10 common cells and keeps the two shortest children; without a common cell it joins the "
        "parents where they are one step apart.",
        "Mutation is that of basic-ga; a mutant that is worse is accepted as in simulated annealing, with "
        "exp((f_mutant - f) / (accuracy T)).",
        "Migration goes round a ring after every generation: copies of the best fifth take the places of the worst.",
        "Fitness is that of AGACD, with which the group compared it. Initialisation is that of bga: the paper of AGACD "
        "times it at 54 s for 45 individuals on 50 × 50, even longer than that of BGA.",
        "There is no elitism; the best individual ever seen in any population is the answer.",
    )

    population: Count = 15
    selection: Selection = KeepAll()
    pairing: Pairing = RandomPairs()
    crossover: Crossover | None = BestMeeting()
    control: Control = ByPopulation()
    migration: Migration | None = RingMigration()
    termination: tuple[Termination, ...] = (MaxGenerations(limit=500),)


@dataclass(frozen=True, kw_only=True)
class MpgaTextbook(DividedPopulation):
    """The multi-population genetic algorithm of textbooks and toolboxes."""

    name: ClassVar[str] = "mpga-textbook"
    reference: ClassVar[str] = (
        "J. P. Cohoon, S. U. Hegde, W. N. Martin, D. Richards (1987), Punctuated equilibria: a parallel genetic "
        "algorithm, Proc. 2nd Int. Conf. on Genetic Algorithms, 148-154; the form with an elite that ends the run is "
        "common in public code"
    )
    bibtex: ClassVar[str] = """\
@inproceedings{cohoon1987punctuated,
  author    = {Cohoon, James P. and Hegde, Shailesh U. and Martin, Worthy N. and Richards, Dana},
  title     = {Punctuated equilibria: a parallel genetic algorithm},
  booktitle = {Proceedings of the Second International Conference on Genetic Algorithms},
  year      = {1987},
  pages     = {148--154}
}
"""
    fidelity: ClassVar[Fidelity] = "standard"
    assumptions: ClassVar[tuple[str, ...]] = (
        "Ten populations of 40 have probabilities of crossover from 0.7 to 0.9, of mutation from 0.001 to 0.05. Public "
        "code draws them at random; here they are spread evenly, and who crosses most mutates least.",
        "After each generation a copy of each population's best takes the place of the next one's worst.",
        "The elite, the best of each population, is never bred: it is the best individual ever seen.",
        "The run ends when that has not changed for 10 generations, or after 500.",
        "Operators on paths are those of basic-ga, fitness is that of AGACD.",
    )

    population: Count = 40
    sampling: Sampling = RandomPerRow()
    mutation: Mutation | None = TwoPoint()
    control: Control = ByPopulation(
        profiles=tuple((0.7 + 0.2 * k / 9, 0.05 - 0.049 * k / 9) for k in range(10)), acceptance="always"
    )
    migration: Migration | None = RingMigration(populations=10, rate=0.0)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=500), Stagnation(patience=10))
