"""Plain genetic algorithms, one for each paper that compares itself with one."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom import Crossover, Evolution, Fidelity, Mutation, Sampling, Selection, Termination, Terms
from pathloom.kernel.selection import Roulette
from pathloom.kernel.termination import MaxGenerations
from pathloom.paths.objectives import Length
from pathloom_baselines.crossover import SinglePoint
from pathloom_baselines.mutation import SingleGene
from pathloom_baselines.sampling import RandomWalk


@dataclass(frozen=True, kw_only=True)
class GaImga(Evolution):
    """The plain genetic algorithm that IMGA is compared with."""

    name: ClassVar[str] = "ga-imga"
    reference: ClassVar[str] = (
        "J. H. Holland (1975), Adaptation in Natural and Artificial Systems, University of Michigan Press; "
        "parameters: K. Li, Q. Hu, J. Liu (2021), doi:10.1155/2021/8836615, section 5.2"
    )
    bibtex: ClassVar[str] = """\
@book{holland1975adaptation,
  author    = {Holland, John H.},
  title     = {Adaptation in Natural and Artificial Systems},
  publisher = {University of Michigan Press},
  year      = {1975}
}
"""
    fidelity: ClassVar[Fidelity] = "reconstructed"
    assumptions: ClassVar[tuple[str, ...]] = (
        "The paper gives the control parameters only: 100 individuals, 50 generations, PC 0.8, PM 0.2.",
        "Paths begin as random walks with the loops cut out.",
        "Fitness is the reciprocal of the length.",
        "Single-point crossover exchanges tails at a node that both parents visit.",
        "Mutation moves one node to a free neighbour if the path stays connected.",
        "There is no elitism and no deletion; the best individual ever seen is the answer.",
    )

    sampling: Sampling = RandomWalk()
    objectives: Terms = Terms({"length": Length()})
    selection: Selection = Roulette()
    crossover: Crossover | None = SinglePoint(rate=0.8)
    mutation: Mutation | None = SingleGene(rate=0.2)
    termination: tuple[Termination, ...] = (MaxGenerations(limit=50),)
