import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays

from pathloom.errors import ProblemError
from pathloom.grid import labels


def naive(blocked: np.ndarray, corners: str) -> np.ndarray:
    """Flood from each cell over the steps that a corner policy permits."""
    height, width = blocked.shape

    def free(r: int, c: int) -> bool:
        return 0 <= r < height and 0 <= c < width and not blocked[r, c]

    def step(r: int, c: int, dr: int, dc: int) -> bool:
        sides = [free(r + dr, c), free(r, c + dc)]
        permitted = {"strict": all(sides), "no-squeeze": any(sides), "allow": True}
        return free(r + dr, c + dc) and permitted[corners]

    found = np.zeros(blocked.shape, dtype=int)
    for seed in np.argwhere(~blocked):
        stack = [tuple(seed)] if not found[tuple(seed)] else []
        number = found.max() + 1
        while stack:
            r, c = stack.pop()
            if found[r, c]:
                continue
            found[r, c] = number
            around = [(dr, dc) for dr in (-1, 0, 1) for dc in (-1, 0, 1) if dr or dc]
            stack += [(r + dr, c + dc) for dr, dc in around if step(r, c, dr, dc)]
    return found


@given(
    blocked=arrays(bool, array_shapes(min_dims=2, max_dims=2, max_side=7)),
    corners=st.sampled_from(["strict", "no-squeeze", "allow"]),
)
@settings(deadline=None)
def test_components_are_those_of_the_permitted_steps(blocked: np.ndarray, corners: str) -> None:
    numbered, flooded = labels(blocked, corners), naive(blocked, corners)
    assert numbered.dtype == np.int32
    pairs = set(zip(numbered.ravel().tolist(), flooded.ravel().tolist(), strict=True))
    assert len(pairs) == len({a for a, _ in pairs}) == len({b for _, b in pairs})
    np.testing.assert_array_equal(numbered == 0, blocked)


def test_only_allow_passes_between_two_obstacles_that_touch() -> None:
    blocked = np.eye(2, dtype=bool)
    assert labels(blocked, "allow").max() == 1
    assert labels(blocked, "no-squeeze").max() == 2
    assert labels(blocked, "strict").max() == 2


def test_an_unknown_corner_policy_is_refused_with_a_hint() -> None:
    with pytest.raises(ProblemError, match="did you mean 'strict'"):
        labels(np.eye(2, dtype=bool), "strickt")
