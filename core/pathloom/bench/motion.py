"""Motions between any two points of the plane, for peers that are not bound to the centres of cells."""

from pathloom.compiled.curves import _clear, _inside
from pathloom.compiled.jit import kernel


@kernel("b1(u1[::1], i8, i8, f8, f8, f8, f8, i8)")
def motion_free(  # type: ignore[no-untyped-def]  # typed by the signature that it is compiled for
    blocked, rows, cols, ar, ac, br, bc, policy
):
    """Say whether a segment, in rows and columns, is free under a corner policy, up to a billionth of a cell."""
    return not _inside(blocked, rows, cols, br, bc) and _clear(blocked, rows, cols, ar, ac, br, bc, policy, 0.0)
