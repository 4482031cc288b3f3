"""Vectors of real numbers that stand for paths: decoders, the loop over them, and swarms."""
