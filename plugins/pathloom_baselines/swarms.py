"""What is true of all swarms here."""

from typing import Literal

Frame = Literal["absolute", "neutral"]
"""Whether coordinates count as printed, from a corner of the map, or so that no place and no direction is favoured."""

DECODED = (
    "The method is for real vectors; as paths they are read by a decoder, way-points anywhere by default.",
    "The first vectors are drawn around the straight way from start to goal, where the field draws them anywhere.",
    "Six way-points and a noise of 0.1 are what found most paths on maps of 20 × 20 with 75 and 102 obstacles.",
    "Paths are compared by Deb's rules: a legal path is better than a colliding one, of two that collide the one "
    "that runs a shorter way inside obstacles.",
)
"""Assumptions that all of them share."""
