"""Policies: learned, measured, and as quick as they must be without deciding otherwise."""

import numpy as np
import pytest

import pathloom as pl
from pathloom.kernel.compose import build
from pathloom.kernel.registry import default_registry
from pathloom.local import Policy, evaluate
from pathloom.local.classifiers import ALLOWED, Classifier
from pathloom.local.measuring import Measures
from pathloom.local.rules import FourLeaves
from pathloom.local.splitting import folds, hold_out

PAPER = ("mnb", "gnb", "svm", "knn", "rf")


def policy(name, **fields):
    return build(Policy, {"use": name, **fields}, default_registry(), "")


@pytest.fixture(scope="module")
def examples():
    return pl.generate(pl.load_map("blocks-20:15%"), 500, FourLeaves(far=2.0), rng=np.random.default_rng(5))


@pytest.mark.parametrize("name", [e.name for e in default_registry().all_entries(Policy)])
def test_every_policy_decides_row_by_row_and_the_same_for_the_same_seed(name, examples):
    first, again = (policy(name).trained(examples, np.random.default_rng(3)) for _ in range(2))
    rows = examples.distances[:40]
    decided = first(rows)
    assert set(decided.tolist()) <= {0, 1, 2, 3}
    assert decided.tolist() == again(rows).tolist() == [int(first(row.reshape(1, -1))[0]) for row in rows]


@pytest.mark.parametrize(
    "made",
    [policy("rf", trees=30), Classifier(), Classifier(classifier="sklearn.ensemble.ExtraTreesClassifier"),
     Classifier(parameters=("max_depth=2",))],
    ids=["rf", "tree", "extra trees", "shallow tree"],
)  # fmt: skip
def test_flat_trees_decide_as_scikit_learn_does(made, examples):
    model = made.trained(examples, np.random.default_rng(0))
    rng = np.random.default_rng(1)
    near = examples.distances[rng.integers(len(examples), size=3000)] + rng.normal(0, 0.05, (3000, 4))
    assert model.forest is not None
    assert model(near).tolist() == model.classifier.predict(near).tolist()


def test_trees_that_lead_astray_are_refused():
    from pathloom.local.forest import _check

    inner, feature, ends = np.array([True, False, False]), np.array([0, -1, -1]), np.array([3, 3, 3])
    for left, right, first in ((0, 2, 0), (1, 3, 0), (1, 2, 4)):
        children = {"left": np.array([left, -1, -1]), "right": np.array([right, -1, -1])}
        with pytest.raises(pl.ConfigError, match="not well formed"):
            _check(inner, np.where(inner, first, feature), children, ends, 4)


def test_a_neighbour_at_no_distance_votes_alone(examples):
    model = policy("knn", neighbours=9).trained(examples, np.random.default_rng(0))
    assert (model(examples.distances) == examples.actions).all()


def test_a_model_takes_as_many_distances_as_it_was_trained_with(examples):
    model = policy("gnb").trained(examples, np.random.default_rng(0))
    with pytest.raises(pl.ConfigError, match="found 2 distances, allowed 4"):
        model(np.ones((1, 2)))
    assert model.on_readings(np.full((1, 24), 3.0)).shape == (1,)


def test_the_split_is_the_papers():
    examples = pl.Examples(np.ones((5456, 2)), np.arange(5456) % 4)
    train, test = hold_out(examples, np.random.default_rng(0))
    assert (len(train), len(test)) == (1636, 3820)
    assert sorted([*train, *test]) == list(range(5456))


@pytest.mark.parametrize("order", ["file", "shuffled"])
def test_folds_test_each_row_once_and_hold_actions_in_equal_shares(examples, order):
    tested = [test for _, test in folds(examples, order, np.random.default_rng(0))]
    assert len(tested) == 10
    assert sorted(np.concatenate(tested).tolist()) == list(range(len(examples)))
    counts = np.array([np.bincount(examples.actions[test], minlength=4) for test in tested])
    assert (np.ptp(counts, axis=0) <= 1).all()


def test_measures_are_those_of_the_definitions():
    real, said = np.array([0, 0, 0, 1, 1, 2]), np.array([0, 0, 1, 1, 1, 0])
    found = Measures.of(real, said)
    assert found.accuracy == pytest.approx(4 / 6)
    assert found.precision == pytest.approx((2 / 3 + 2 / 3 + 0) / 3)
    assert found.recall == pytest.approx((2 / 3 + 1 + 0) / 3)
    assert found.f1 == pytest.approx((2 / 3 + 4 / 5 + 0) / 3)
    assert found.confusion == ((2, 1, 0, 0), (0, 2, 0, 0), (1, 0, 0, 0), (0, 0, 0, 0))
    table = np.array(found.confusion)
    right, all_, by_real, by_said = np.trace(table), table.sum(), table.sum(1), table.sum(0)
    root = np.sqrt((all_**2 - by_said @ by_said) * (all_**2 - by_real @ by_real))
    assert found.mcc == pytest.approx((right * all_ - by_real @ by_said) / root)


def test_a_rule_that_made_the_labels_makes_no_mistake_and_curves_end_at_all_rows(examples):
    found = evaluate(FourLeaves(far=2.0), examples, seed=1, draws=2, curve=True).to_dict()
    assert found["holdout"]["accuracies"] == [1.0, 1.0]
    assert found["tenfold"]["accuracy"] == found["tenfold_shuffled"]["mcc"] == 1.0
    assert [point["train"] for point in found["learning_curve"]] == [50, 100, 150]


def test_a_classifier_that_is_not_on_the_list_is_not_imported():
    for name in ("sklearn.svm.svc", "os.system", "sklearn.tree.DecisionTreeRegressor"):
        with pytest.raises(pl.ConfigError, match="classifier: found"):
            Classifier(classifier=name)
    assert all(name.startswith("sklearn.") for name in ALLOWED)
    with pytest.raises(pl.ConfigError, match="has no parameter 'max_dept'; did you mean 'max_depth'"):
        Classifier(parameters=("max_dept=3",)).estimator(0)
    with pytest.raises(pl.ConfigError, match="not the seed"):
        Classifier(parameters=("random_state=3",))


def test_what_cannot_be_learned_from_is_refused():
    alike = pl.Examples(np.ones((9, 2)), np.zeros(9, int))
    with pytest.raises(pl.ConfigError, match="found the action 0 only"):
        policy("gnb").trained(alike, np.random.default_rng(0))
    few = pl.Examples(np.ones((9, 2)), np.arange(9) % 4)
    with pytest.raises(pl.ConfigError, match="knn: not trained on 9 examples"):
        policy("knn", neighbours=10).trained(few, np.random.default_rng(0))
    with pytest.raises(pl.ConfigError, match="allowed \\(n, k\\)"):
        pl.Examples(np.ones((9, 3)), np.zeros(9, int))


@pytest.mark.data
def test_on_the_recorded_data_accuracies_are_those_known(data):
    from pathloom.local import read_examples

    recorded = read_examples(data / "uci_wall_following" / "sensor_readings_4.data")
    known = {"mnb": (0.50, 0.65, 0.584), "gnb": (0.87, 0.91, 0.884), "svm": (0.91, 0.95, 0.935),
             "knn": (0.94, 0.97, 0.940), "rf": (0.996, 1.0, 0.998)}  # fmt: skip
    for name, (least, most, tenfold) in known.items():
        made = policy(name, trees=30) if name == "rf" else policy(name)
        found = evaluate(made, recorded, draws=2, orders=("file",)).to_dict()
        assert least <= found["holdout"]["least"] <= found["holdout"]["most"] <= most, name
        assert found["tenfold"]["accuracy"] == pytest.approx(tenfold, abs=0.01), name


@pytest.mark.data
def test_what_learned_from_generated_examples_alone_is_right_on_the_recorded_ones(data):
    from pathloom.local import read_examples

    recorded = read_examples(data / "uci_wall_following" / "sensor_readings_4.data")
    rng = np.random.default_rng(0)
    model = policy("rf", trees=30).trained(pl.generate(pl.load_map("blocks-30:15%"), 6000, FourLeaves(), rng=rng), rng)
    assert (model(recorded.distances) == recorded.actions).mean() >= 0.95
