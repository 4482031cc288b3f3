"""Choosing from a front: knee, pseudo-weights, preferences."""

import warnings

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from naive import examples

from pathloom.fronts import knee, non_dominated, preferred, pseudo_weights

CURVE = np.array([[0.0, 10.0], [1.0, 2.0], [4.0, 1.0], [10.0, 0.0]])


@st.composite
def fronts(draw):
    m = draw(st.integers(2, 5))
    rows = draw(st.lists(st.tuples(*[st.integers(0, 20)] * m), min_size=1, max_size=15))
    return non_dominated(np.array(rows, float))


@st.composite
def fronts_and_weights(draw):
    front = draw(fronts())
    weights = draw(st.lists(st.integers(0, 4), min_size=front.shape[1], max_size=front.shape[1]))
    assume(any(weights))
    return front, weights


def test_the_knee_is_where_the_curve_bends():
    assert knee(CURVE) == 1


@given(fronts())
@examples(60)
def test_the_knee_moves_with_scale_and_place_of_the_objectives(front):
    moved = front * np.arange(2, 2 + front.shape[1]) + 7
    assert knee(moved) == knee(front)


def test_pseudo_weights_are_worked_out_by_hand():
    # (1, 2): gains 9/10 and 8/10
    np.testing.assert_allclose(pseudo_weights(CURVE)[1], (9 / 17, 8 / 17))
    np.testing.assert_allclose(pseudo_weights(CURVE)[[0, 3]], [(1, 0), (0, 1)])


@given(fronts())
@examples(60)
def test_pseudo_weights_are_shares(front):
    found = pseudo_weights(front)
    assert (found >= 0).all()
    np.testing.assert_allclose(found.sum(axis=1), 1.0)


@given(fronts())
@examples(40)
def test_pseudo_weights_are_those_of_pymoo(front):
    assume((np.ptp(front, axis=0) > 0).all())
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # pymoo imports a module that scipy is about to drop
        from pymoo.mcdm.pseudo_weights import PseudoWeights
    m = front.shape[1]
    chosen, theirs = PseudoWeights(np.full(m, 1 / m)).do(front, return_pseudo_weights=True)
    np.testing.assert_allclose(pseudo_weights(front), theirs)
    near = np.abs(theirs - 1 / m).sum(axis=1)
    assert near[preferred(front, np.ones(m))] == pytest.approx(near[chosen])


@given(fronts(), st.data())
@examples(60)
def test_who_wants_one_objective_alone_gets_the_best_of_it(front, data):
    k = data.draw(st.integers(0, front.shape[1] - 1))
    assert front[preferred(front, np.eye(front.shape[1])[k]), k] == front[:, k].min()


@given(fronts_and_weights())
@examples(60)
def test_what_is_preferred_is_dominated_in_nothing_that_was_asked_for(drawn):
    front, weights = drawn
    asked = np.array(weights) > 0
    chosen = front[preferred(front, weights)][asked]
    rest = front[:, asked]
    assert not ((rest <= chosen).all(axis=1) & (rest < chosen).any(axis=1)).any()


@given(fronts_and_weights())
@examples(40)
def test_only_the_ratio_of_weights_counts(drawn):
    front, weights = drawn
    assert preferred(front, weights) == preferred(front, 3.0 * np.array(weights))


def test_a_hollow_front_can_be_chosen_from_where_no_weighted_sum_reaches():
    hollow = np.array([[0.0, 10.0], [6.0, 6.0], [10.0, 0.0]])
    assert preferred(hollow, (1, 1)) == 1
