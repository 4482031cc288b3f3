"""Citing: the planner's own work, the papers of its parts, and nothing else."""

from dataclasses import dataclass

import pathloom as pl
from pathloom.kernel.citing import Work, works_of
from pathloom.kernel.compose import compose
from pathloom.paths.objectives import Length
from pathloom.paths.tree_seeding import PerturbedTrees


def keys(*planners):
    return [work.key for work in works_of(map(compose, planners))]


def test_a_planner_is_cited_by_its_own_work_and_not_by_those_of_its_neighbours():
    assert keys("baselines/ga-imga") == ["holland1975adaptation"]
    assert keys("nsga2") == ["deb2002nsga2"]


def test_the_paper_of_a_part_comes_after_the_planners_own():
    assert keys({"use": "ga-imga", "crossover": "imga/common-node"}) == ["holland1975adaptation", "li2021imga"]


def test_each_work_is_cited_once():
    assert keys("imga", "imga") == ["li2021imga"]


def test_what_has_no_reference_is_not_cited():
    @dataclass(frozen=True, kw_only=True)
    class Mine(pl.Evolution):
        """Nobody has published it."""

    assert works_of([Mine(sampling=PerturbedTrees(), objectives=pl.Terms([pl.Term("length", Length())]))]) == []


def test_a_key_stands_in_its_entry():
    assert Work("A. Author (2020), A title", "@book{author2020,\n}").key == "author2020"
    assert Work("A. Author (2020), A title", "").key == ""


def test_a_part_of_a_part_and_an_objective_are_cited_too():
    crossover = {"use": "best-meeting", "probability": "iga/sinc-adaptive"}
    assert keys({"use": "ga-imga", "crossover": crossover}) == ["holland1975adaptation", "liu2024iga"]
    assert keys({"use": "ga-imga", "objectives": ["imga/unsafe-node"]}) == ["holland1975adaptation", "li2021imga"]


def test_a_part_with_a_work_of_its_own_is_cited_by_that():
    @dataclass(frozen=True, kw_only=True)
    class Published(pl.Selection):
        """A part that somebody has published without a planner."""

        reference = "A. Author (2030), A selection"
        bibtex = "@article{author2030,\n}"

        def select(self, fitness, n, rng):
            return rng.integers(len(fitness), size=n)

    planner = compose("ga-imga", selection=Published())
    assert [work.key for work in works_of([planner])] == ["holland1975adaptation", "author2030"]
