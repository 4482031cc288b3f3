"""Tuning of parameters by designed experiments."""

from pathloom.study.tuning.result import Tuning as Tuning
from pathloom.study.tuning.experiment import tune as tune
