"""Tuning of parameters by designed experiments."""

from pathloom.study.tuning.result import Tuning as Tuning
from pathloom.study.tuning.tune import tune as tune
