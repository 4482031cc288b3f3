"""Paths on occupancy grids: the problem, its representation, and what several papers share."""
