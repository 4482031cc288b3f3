"""Section 5.2.1: parameters by designed experiments, eqs. (30) and (31); the arithmetic of ``pathloom tune``."""

from pathloom.study.tuning.effects import MainEffects, aliases, correlations, level_means, main_effects

__all__ = ["MainEffects", "aliases", "correlations", "level_means", "main_effects"]
