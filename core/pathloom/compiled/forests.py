"""Decision trees as flat arrays, and the vote of a forest of them."""

import numpy as np

from pathloom.compiled.jit import kernel


@kernel("i8[::1](i8[::1], i4[::1], f8[::1], i4[::1], i4[::1], f8[:, ::1], f4[:, ::1])")
def vote(roots, feature, threshold, left, right, shares, rows):
    """Return for each row (n, features) the class that most trees are for: (n,), the first of equals.

    All nodes of all trees stand one after the other. ``feature`` is −1 in a leaf, whose
    ``shares`` (nodes, classes) are added up tree by tree; elsewhere a row goes left where its
    feature is at most the threshold.
    """
    chosen = np.empty(rows.shape[0], np.int64)
    total = np.empty(shares.shape[1])
    for n in range(rows.shape[0]):
        total[:] = 0.0
        for t in range(roots.shape[0]):
            node = roots[t]
            while feature[node] >= 0:
                node = np.int64(left[node] if rows[n, feature[node]] <= threshold[node] else right[node])
            for c in range(shares.shape[1]):
                total[c] += shares[node, c]
        best = 0
        for c in range(1, shares.shape[1]):
            if total[c] > total[best]:
                best = c
        chosen[n] = best
    return chosen
