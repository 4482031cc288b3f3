"""Random numbers inside kernels: xoshiro256++ (Blackman and Vigna 2019) on a uint64[4] state.

A numpy ``Generator`` costs 19 µs to hand into a kernel and 63 ns a number; this
costs nothing to hand in. Callers seed it from their generator with four words:
``rng.bit_generator.random_raw(4)``.
"""

import numpy as np

from pathloom.compiled.jit import part

_23, _41, _17, _45, _19 = (np.uint64(k) for k in (23, 41, 17, 45, 19))
_11, _32 = np.uint64(11), np.uint64(32)


@part("u8(u8[::1])")
def next_word(state):
    """Return the next 64 random bits."""
    total = state[0] + state[3]
    word = ((total << _23) | (total >> _41)) + state[0]
    shifted = state[1] << _17
    state[2] ^= state[0]
    state[3] ^= state[1]
    state[1] ^= state[2]
    state[0] ^= state[3]
    state[2] ^= shifted
    state[3] = (state[3] << _45) | (state[3] >> _19)
    return word


@part("i8(u8[::1], i8)")
def below(state, bound):
    """Return a random integer in [0, bound), bound < 2**31, by multiplication (bias below 2**-32)."""
    return np.int64(((next_word(state) >> _32) * np.uint64(bound)) >> _32)


@part("f8(u8[::1])")
def uniform(state):
    """Return a random number in [0, 1)."""
    return np.float64(next_word(state) >> _11) * (1.0 / 9007199254740992.0)
