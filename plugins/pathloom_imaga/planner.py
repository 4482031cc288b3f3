"""Sections 2.7 and 3: the planner, with the paper's parameters."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import (
    Archive,
    Control,
    Count,
    Crossover,
    Evolution,
    Fidelity,
    Fitness,
    Mutation,
    Repair,
    Sampling,
    Selection,
    Survival,
    Termination,
    Terms,
    Weighting,
)
from pathloom.kernel.archive import BestRefined
from pathloom.kernel.evaluation import WeightedReciprocals
from pathloom.kernel.survival import KeepBest
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.deletion import PointDeletion
from pathloom.paths.objectives import Length
from pathloom_imaga.control import AdaptiveEvolution
from pathloom_imaga.crossover import PositionalSinglePoint
from pathloom_imaga.mutation import D4GeneMedian
from pathloom_imaga.objectives import D4ObstacleCount, EnergyPerLength
from pathloom_imaga.probability import BandedAdaptive
from pathloom_imaga.sampling import RestrictedUniform
from pathloom_imaga.selection import GreedyRoulette
from pathloom_imaga.weighting import ReferenceScaled


@dataclass(frozen=True, kw_only=True)
class Imaga(Evolution):
    """IMAGA, the improved multi-objective adaptive genetic algorithm."""

    name: ClassVar[str] = "imaga"
    reference: ClassVar[str] = (
        "Zhang Z., Ke Z., Zhou J., Qian Q., Hu X. (2023), Robot path planning based on improved multi-objective "
        "adaptive genetic algorithm, Journal of Xi'an University of Technology 39(1), 69-78, "
        "doi:10.19322/j.cnki.issn.1006-4710.2023.01.007 (in Chinese)"
    )
    bibtex: ClassVar[str] = """\
@article{zhang2023imaga,
  author  = {Zhang, Zheng and Ke, Zipeng and Zhou, Jiazheng and Qian, Qinjian and Hu, Xinyu},
  title   = {Robot path planning based on improved multi-objective adaptive genetic algorithm},
  journal = {Journal of Xi'an University of Technology},
  year    = {2023},
  volume  = {39},
  number  = {1},
  pages   = {69--78},
  doi     = {10.19322/j.cnki.issn.1006-4710.2023.01.007},
  note    = {In Chinese}
}
"""
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The paper gives neither population nor generations: 100 and 50, as in IMGA, whose parts it takes up.",
        "The step (5) is 3, which leaves 2 rows and columns from node to node; the last node is held to it as well. "
        "Model (11) as printed never exceeds 0.146; a fit for each map (sampling.prior) chooses 3 too.",
        "Median insertion (2.1) is guarded against going in circles, and cuts loops out.",
        "The third term of (12) is 1/E, though the text explains T(k); S below 1 counts as 1.",
        "The weights (12) are not given: every term is scaled by its value on a shortest 8-connected path, and then "
        "counts the same. Unscaled, energy decides nearly alone.",
        "Energy (16) is (T + D) / D, as in tables 1 and 2; no ω gives them.",
        "The best parent takes one place in the pool (2.3) and is put back after the generation as well.",
        "Bands (19) (20): thresh is 3. A pair is crossed with the rate of its fitter parent, and a child mutated with "
        "the rate of the parent whose place it takes.",
        "Single-point crossover (2.4) cuts both parents at one position, inside the shorter, and joins by median "
        "insertion; a child that cannot be joined is its parent again.",
        "Adaptive evolution (23) goes on while no child is better than the best parent, which is judged before that "
        "parent is put back, and at most 3 times.",
        "Deletion (2.6) uses the exact segment test: with the midpoints of (25) alone paths come out that are shorter "
        "than any free one, and than the printed ones; with blocked points put back the printed ones are out of reach.",
        "Deletion goes on until no node is redundant by its own test; one pass leaves some.",
        "The answer is the shortest path that deletion makes of any individual, though the paper says: of the final "
        "best (archive none), with which our runs do not reach the printed lengths. As it stands, sampling and "
        "deletion alone do as well, so that these lengths are no evidence for the operators in between.",
        "Between cells whose diagonal the corner policy forbids, a cell beside it is inserted.",
    )

    population: Count = 100
    sampling: Sampling = RestrictedUniform()
    objectives: Terms = Terms({"length": Length(), "safety": D4ObstacleCount(), "energy": EnergyPerLength()})
    weighting: Weighting | None = ReferenceScaled()
    fitness: Fitness = WeightedReciprocals(floors=(1e-9, 1.0, 1e-9))  # only S can be 0 on a way
    selection: Selection = GreedyRoulette()
    crossover: Crossover | None = PositionalSinglePoint(probability=BandedAdaptive(base=0.8))  # eq. (19)
    mutation: Mutation | None = D4GeneMedian(probability=BandedAdaptive(base=0.2))  # eq. (20)
    survival: Survival = KeepBest()
    control: Control = AdaptiveEvolution()
    refinement: Repair | None = PointDeletion(passes=0)
    archive: Archive | None = BestRefined(objective=Length())
    termination: tuple[Termination, ...] = (MaxGenerations(limit=50),)
