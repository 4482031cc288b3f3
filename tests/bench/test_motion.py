"""The test of motions that the peers in the plane are given, held against the validator of curves."""

from types import SimpleNamespace

import numpy as np
import pytest

from pathloom.bench.motion import motion_free
from pathloom.bench.suite import problem_on
from pathloom.exact.curves import validate_curve


@pytest.mark.parametrize("corners", ["allow", "no-squeeze", "strict"])
def test_a_motion_is_free_where_the_validator_lets_it_pass(corners):
    problem = problem_on("random-12:20%:s3", corners)
    it = problem.context
    rng = np.random.default_rng(1)
    met = {True: 0, False: 0}
    for _ in range(600):
        a = rng.uniform(-0.49, 11.49, 2)
        b = np.clip(a + rng.normal(0.0, 2.5, 2), -0.49, 11.49)
        free = motion_free(it.blocked, it.rows, it.cols, *a, *b, it.policy)
        met[bool(free)] += 1
        why = validate_curve(np.array([a, b]), between(a, b, problem))
        assert free == (why is None), (a, b, why)
    assert min(met.values()) > 50


def between(a, b, problem):
    """Return what the validator asks of a problem, with ends that need not be cells."""
    return SimpleNamespace(ends=(tuple(a), tuple(b)), context=problem.context, corners=problem.corners)
