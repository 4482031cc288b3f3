"""Which free cells can reach each other: answered before any search or evolution starts."""

import difflib

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import ProblemError

CORNER_POLICIES = ("strict", "no-squeeze", "allow")


def labels(blocked: NDArray[np.bool_], corners: str) -> NDArray[np.int32]:
    """Return the component of each free cell under a corner policy.

    Two free cells are joined by a path exactly when they bear the same number. `allow`
    joins diagonal neighbours. The other two policies permit a diagonal step only beside
    a free cell, over which two straight steps do the same; so their components are
    those of the four straight neighbours.

    Parameters
    ----------
    blocked
        (H, W).
    corners
        `strict`, `no-squeeze` or `allow`.

    Returns
    -------
    (H, W): 0 where blocked, otherwise 1, 2, ....

    Raises
    ------
    ProblemError
        If there is no such corner policy.
    """
    from scipy import ndimage

    if corners not in CORNER_POLICIES:
        near = difflib.get_close_matches(str(corners), CORNER_POLICIES, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise ProblemError(f"corners: found {corners!r}, allowed {', '.join(CORNER_POLICIES)}{hint}")
    neighbours = ndimage.generate_binary_structure(2, 2 if corners == "allow" else 1)
    numbered = np.zeros(blocked.shape, dtype=np.int32)
    ndimage.label(~np.asarray(blocked, dtype=np.bool_), structure=neighbours, output=numbered)
    return numbered
