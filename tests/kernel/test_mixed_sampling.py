"""Several samplings in one."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.sampling import Mixed

PROBLEM = SimpleNamespace(representation=SimpleNamespace(stack=lambda first, second: np.concatenate((first, second))))


@dataclass(frozen=True, kw_only=True)
class Marked(pl.Sampling):
    """Rows that say who made them, at most so many."""

    gives = frozenset({"a", "b"})
    mark: int = 0
    most: int = 1000

    def sample(self, problem, n, rng):
        return np.full((min(n, self.most), 2), self.mark)


@dataclass(frozen=True, kw_only=True)
class Other(Marked):
    """The same, with other promises."""

    gives = frozenset({"b", "c"})


def counts(mixed, n):
    population = mixed.sample(PROBLEM, n, np.random.default_rng(0))
    assert len(population) <= n
    return np.bincount(population[:, 0], minlength=len(mixed.parts)).tolist()


@pytest.mark.parametrize(
    ("shares", "n", "wanted"),
    [((), 9, [3, 3, 3]), ((1, 1, 2), 100, [25, 25, 50]), ((0, 0.5, 0.5), 10, [0, 5, 5]), ((1, 0, 0), 4, [4, 0, 0])],
)
def test_each_part_has_its_share(shares, n, wanted):
    assert counts(Mixed(parts=tuple(Marked(mark=k) for k in range(3)), shares=shares), n) == wanted


@pytest.mark.parametrize("n", range(12))
def test_shares_that_do_not_divide_add_up_all_the_same(n):
    assert sum(counts(Mixed(parts=tuple(Marked(mark=k) for k in range(3)), shares=(0.3, 0.3, 0.3)), n)) == n


@pytest.mark.parametrize(
    ("shares", "n", "wanted"), [((39, 1, 0), 20, [19, 1, 0]), ((1, 98, 1), 10, [1, 8, 1]), ((1, 98, 1), 3, [1, 1, 1])]
)
def test_who_has_a_share_has_one_individual_where_there_are_enough(shares, n, wanted):
    assert counts(Mixed(parts=tuple(Marked(mark=k) for k in range(3)), shares=shares), n) == wanted


def test_the_next_ones_make_up_for_what_one_cannot_supply():
    parts = (Marked(mark=0, most=2), Marked(mark=1, most=0), Marked(mark=2))
    assert counts(Mixed(parts=parts), 30) == [2, 0, 28]
    assert counts(Mixed(parts=parts[::-1]), 30) == [2, 0, 10]


def test_only_what_all_parts_give_is_given():
    assert Mixed(parts=(Marked(), Other())).gives == {"b"}
    assert Mixed(parts=(Marked(),)).gives == {"a", "b"}


@pytest.mark.parametrize("shares", [(1.0,), (0.0, 0.0), (np.inf, 1.0), (-1.0, 2.0)])
def test_shares_without_sense_are_refused(shares):
    with pytest.raises(pl.ConfigError, match="share"):
        Mixed(parts=(Marked(), Other()), shares=shares)


def test_at_least_one_part_is_needed():
    with pytest.raises(pl.ConfigError, match="at least one sampling"):
        Mixed(parts=())
