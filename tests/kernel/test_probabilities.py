"""Adaptive probabilities, against the formulas of their papers in fractions."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from naive import examples

from pathloom.compiled import probabilities

shares = st.floats(0.0, 1.0)
whole_fitness = st.lists(st.integers(0, 40).map(float), min_size=1, max_size=9)
"""Small whole numbers, whose mean is on the same side of each of them in floats as in fractions."""
any_fitness = st.lists(st.floats(0.0, 1e9) | st.just(math.inf), min_size=1, max_size=9)


def falling(fitness: list[float], equal: float, above: float, below: float, factor: float) -> list[float]:
    """Hao et al. 2021, eqs. 26 to 29, without the cut to [0, 1]."""
    highest, mean = max(fitness), sum(map(Fraction, fitness)) / len(fitness)

    def rate(f: float) -> float:
        if highest == mean:
            return equal
        return above * float((Fraction(highest) - Fraction(f)) / (Fraction(highest) - mean)) if f >= mean else below

    return [rate(f) * factor for f in fitness]


def banded(fitness: list[float], base: float, swing: float, thresh: int) -> list[float]:
    """Zhang et al. 2023, eqs. 19 and 20."""
    lowest, highest = Fraction(min(fitness)), Fraction(max(fitness))
    band = (highest - lowest) / thresh

    def rate(f: float) -> float:
        if lowest == highest:
            return base
        r = float((highest - Fraction(f)) / (highest - lowest))
        if f < lowest + band:
            return base + swing * r
        return base * r if f > lowest + (thresh - 1) * band else base

    return [rate(f) for f in fitness]


def sinc(fitness: list[float], low: float, high: float) -> list[float]:
    """Liu et al. 2024, eqs. 6 to 8."""
    highest, mean = max(fitness), sum(map(Fraction, fitness)) / len(fitness)

    def rate(f: float) -> float:
        if highest == mean or f < mean:
            return high
        x = math.pi * float((Fraction(f) - mean) / (Fraction(highest) - mean))
        return low + (math.sin(x) / x if x else 1.0) * float(mean / Fraction(highest)) * (high - low)

    return [rate(f) for f in fitness]


def cut(rates: list[float]) -> list[float]:
    return [min(max(rate, 0.0), 1.0) for rate in rates]


@given(fitness=whole_fitness, equal=shares, above=shares, below=shares, factor=st.floats(math.exp(-1), math.e))
@examples(150)
def test_falling_rates_are_those_of_the_formula(fitness, equal, above, below, factor) -> None:
    found = probabilities.falling(np.array(fitness), equal, above, below, factor)
    assert found == pytest.approx(cut(falling(fitness, equal, above, below, factor)), abs=1e-12)


@given(fitness=whole_fitness, base=shares, swing=shares, thresh=st.integers(2, 8))
@examples(150)
def test_banded_rates_are_those_of_the_formula(fitness, base, swing, thresh: int) -> None:
    found = probabilities.banded(np.array(fitness), base, swing, thresh)
    assert found == pytest.approx(cut(banded(fitness, base, swing, thresh)), abs=1e-12)


@given(fitness=whole_fitness, low=shares, high=shares)
@examples(150)
def test_sinc_rates_are_those_of_the_formula(fitness, low: float, high: float) -> None:
    found = probabilities.sinc(np.array(fitness), low, high)
    assert found == pytest.approx(cut(sinc(fitness, low, high)), abs=1e-12)


@given(value=st.floats(1e-9, 1e9) | st.just(math.inf), n=st.integers(1, 60))
@examples(80)
def test_where_all_are_as_fit_rounding_makes_nobody_the_best(value: float, n: int) -> None:
    fitness = np.full(n, value)  # the sum of ten times 0.1, by ten, is less than 0.1
    assert set(probabilities.falling(fitness, 0.3, 0.7, 0.9, 1.0)) == {0.3}
    assert set(probabilities.banded(fitness, 0.8, 0.2, 3.0)) == {0.8}
    assert set(probabilities.sinc(fitness, 0.1, 0.7)) == {0.7}


@given(fitness=any_fitness)
@examples(100)
def test_the_best_have_the_least_rate_and_the_less_fit_no_lower_one(fitness: list[float]) -> None:
    if len(set(fitness)) == 1:
        return
    found = [
        (0.0, probabilities.falling(np.array(fitness), 0.3, 0.7, 0.9, 1.0)),
        (0.0, probabilities.banded(np.array(fitness), 0.8, 0.2, 3.0)),
        (0.1, probabilities.sinc(np.array(fitness), 0.1, 0.7)),
    ]
    for least, rates in found:
        assert rates[np.argmax(fitness)] == pytest.approx(least, abs=1e-12)
        by_fitness = rates[np.argsort(fitness, kind="stable")]
        assert (np.diff(by_fitness) <= 1e-12).all()


def test_next_to_the_best_by_the_last_bit_nobody_but_the_best_is_the_best() -> None:
    fitness = np.array([0.1, np.nextafter(0.1, 1.0), 0.1])  # in floats their mean is one of the two
    assert probabilities.falling(fitness, 0.3, 0.7, 0.9, 1.0)[1] == 0.0
    assert probabilities.sinc(fitness, 0.1, 0.7)[1] == pytest.approx(0.1)
    for rates in (probabilities.falling(fitness, 0.3, 0.7, 0.9, 1.0), probabilities.sinc(fitness, 0.1, 0.7)):
        assert rates[0] == rates[2] > 0.5


def test_the_best_stay_the_best_where_the_mean_is_rounded_beyond_them() -> None:
    fitness = np.array([np.nextafter(0.1, 0.0), 0.1, 0.1])
    assert (fitness[0] + fitness[1] + fitness[2]) / 3 > 0.1
    assert probabilities.falling(fitness, 0.3, 0.7, 0.9, 1.0).tolist() == [0.9, 0.0, 0.0]
    assert probabilities.sinc(fitness, 0.1, 0.7) == pytest.approx([0.7, 0.1, 0.1])


def test_the_infinitely_fit_are_the_best_and_all_others_are_far_below() -> None:
    fitness = np.array([1.0, math.inf, 0.0, 2.0, math.inf])
    assert probabilities.falling(fitness, 0.3, 0.7, 0.9, 1.0).tolist() == [0.9, 0.0, 0.9, 0.9, 0.0]
    assert probabilities.banded(fitness, 0.8, 0.2, 3.0).tolist() == [1.0, 0.0, 1.0, 1.0, 0.0]
    assert probabilities.sinc(fitness, 0.1, 0.7) == pytest.approx([0.7, 0.1, 0.7, 0.7, 0.1])


@given(
    fitness=st.lists(st.floats(-1e9, 1e9) | st.just(math.inf), max_size=9) | st.lists(st.just(-math.inf), max_size=2),
    rates=st.tuples(*[st.floats(-2.0, 2.0)] * 3),
    factor=st.floats(0.0, 3.0),
    bands=st.integers(1, 9),
)
@examples(150)
def test_rates_are_probabilities_whatever_comes_in(fitness, rates, factor: float, bands: int) -> None:
    values = np.array(fitness, float)
    for found in (
        probabilities.falling(values, *rates, factor),
        probabilities.banded(values, *rates[:2], bands),
        probabilities.sinc(values, *rates[:2]),
    ):
        assert found.shape == values.shape
        assert ((found >= 0.0) & (found <= 1.0)).all()


def test_one_individual_is_as_fit_as_all() -> None:
    alone = np.array([5.0])
    assert probabilities.falling(alone, 0.3, 0.7, 0.9, 2.0).tolist() == [0.6]
    assert probabilities.banded(alone, 0.8, 0.2, 3.0).tolist() == [0.8]
    assert probabilities.sinc(alone, 0.1, 0.7).tolist() == [0.7]


def test_crossover_of_agacd_falls_from_its_high_rate_at_the_mean_over_the_run() -> None:
    fitness = np.array([1.0, 2.0, 3.0])  # the mean is 2
    start = probabilities.falling(fitness, 0.65, 0.7, 0.7, 1.0)
    end = probabilities.falling(fitness, 0.65, 0.7, 0.7, math.exp(-1.0))
    assert start.tolist() == [0.7, 0.7, 0.0]
    assert end == pytest.approx(0.7 / math.e * np.array([1.0, 1.0, 0.0]))


def test_mutation_of_agacd_jumps_at_the_mean_and_is_cut_where_it_would_pass_one() -> None:
    fitness = np.array([0.0, 2.0, 3.0, 3.0])  # the mean is 2
    assert probabilities.falling(fitness, 0.3, 0.15, 0.3, 1.0).tolist() == [0.3, 0.15, 0.0, 0.0]
    assert probabilities.falling(fitness, 0.4, 0.2, 0.4, math.e)[0] == 1.0  # 0.4 e is 1.087


def test_banded_rates_jump_at_the_edges_of_the_middle_band() -> None:
    fitness = np.array([0.0, 1e9 - 1, 1e9, 2e9, 2e9 + 1, 3e9])
    crossover = probabilities.banded(fitness, 0.8, 0.2, 3.0)
    mutation = probabilities.banded(fitness, 0.2, 0.2, 3.0)
    assert crossover == pytest.approx([1.0, 0.8 + 0.4 / 3, 0.8, 0.8, 0.8 / 3, 0.0])
    assert mutation == pytest.approx([0.4, 0.2 + 0.4 / 3, 0.2, 0.2, 0.2 / 3, 0.0])


@pytest.mark.parametrize("thresh", range(2, 13))
def test_whoever_stands_on_the_edge_of_a_band_is_in_the_middle(thresh: int) -> None:
    rates = probabilities.banded(np.arange(thresh + 1.0), 0.8, 0.2, thresh)
    assert rates[1:-1].tolist() == [0.8] * (thresh - 1)
    assert (rates[0], rates[-1]) == (1.0, 0.0)


def test_sinc_rates_jump_at_the_mean_by_what_it_lacks_to_the_best() -> None:
    fitness = np.array([1.0, 2.0, 3.0])
    low, high = 0.5, 0.8
    below, at_the_mean, best = probabilities.sinc(fitness, low, high)
    assert below == high
    assert below - at_the_mean == pytest.approx((1 - 2 / 3) * (high - low))
    assert best == pytest.approx(low)


def test_sinc_rates_of_fitness_below_zero_are_low_above_the_mean() -> None:
    assert probabilities.sinc(np.array([-3.0, 0.0, -1.0]), 0.1, 0.7) == pytest.approx([0.7, 0.1, 0.1])


def test_fitness_is_left_as_it_is() -> None:
    fitness = np.array([3.0, 1.0, math.inf])
    for _ in range(2):
        probabilities.falling(fitness, 0.3, 0.7, 0.9, 1.0)
        probabilities.banded(fitness, 0.8, 0.2, 3.0)
        probabilities.sinc(fitness, 0.1, 0.7)
    assert fitness.tolist() == [3.0, 1.0, math.inf]
