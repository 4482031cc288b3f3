"""Which paths are the same, told by 64-bit hashes."""

import numpy as np

from pathloom.compiled.jit import kernel, part
from pathloom.compiled.rows import hash_of, length_of


@part("i8(i8[::1], u8[::1], u8, i8)")
def _place(table, hashes, value, k):
    """Put item k with a hash into an open table of items; return the item of the same hash, or k."""
    mask = np.uint64(table.shape[0] - 1)
    slot = (value >> np.uint64(20)) & mask
    while table[slot] >= 0 and hashes[table[slot]] != value:
        slot = (slot + np.uint64(1)) & mask
    if table[slot] < 0:
        table[slot] = k
    return table[slot]


@part("i8[::1](i8)")
def _table(items):
    """Return an open table, empty, for so many items."""
    size = 4
    while size < 2 * items:
        size *= 2
    table = np.empty(size, np.int64)
    for i in range(size):
        table[i] = -1
    return table


@kernel("Tuple((i8[::1], i8[::1]))(i4[:, ::1])")
def distinct(population):
    """Return the index of the first of each different path, and for each path which of those it is.

    Paths are told apart by a 64-bit hash.
    """
    n = population.shape[0]
    table = _table(n)
    hashes = np.empty(n, np.uint64)
    first = np.empty(n, np.int64)
    which = np.empty(n, np.int64)
    different = 0
    for k in range(n):
        hashes[k] = hash_of(population[k], length_of(population[k]))
        same = _place(table, hashes, hashes[k], k)
        if same == k:
            first[different] = k
            which[k] = different
            different += 1
        else:
            which[k] = which[same]
    return first[:different].copy(), which


@kernel("i8[::1](i4[:, ::1], i4[:, ::1])")
def newcomers(population, before):
    """Return the index of each path that was not there before, told apart by a 64-bit hash."""
    n, m = population.shape[0], before.shape[0]
    table = _table(m)
    hashes = np.empty(m + n, np.uint64)
    for k in range(m):
        hashes[k] = hash_of(before[k], length_of(before[k]))
        _place(table, hashes, hashes[k], k)
    new = np.empty(n, np.int64)
    count = 0
    mask = np.uint64(table.shape[0] - 1)
    for k in range(n):
        value = hash_of(population[k], length_of(population[k]))
        slot = (value >> np.uint64(20)) & mask
        while table[slot] >= 0 and hashes[table[slot]] != value:
            slot = (slot + np.uint64(1)) & mask
        if table[slot] < 0:
            new[count] = k
            count += 1
    return new[:count].copy()
