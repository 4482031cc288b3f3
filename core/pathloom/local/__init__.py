"""Local planning: deciding from what a robot senses where it goes next, learned or by rule, and driving by it.

``examples`` and ``reading`` are what is learned from, ``policy`` and ``classifiers`` who learns, ``measuring`` and
``evaluating`` how well, ``saving`` where a model is kept; ``robot`` and ``sensing`` are the simulated robot,
``generating`` lets it make examples, ``drivers`` and ``driving`` close the loop. All lengths are metres, all angles
radians, counter-clockwise; x goes to the right and y upwards from the lower-left corner of the map.
"""

from pathloom.local.driving import ClosedLoop, Episode
from pathloom.local.evaluating import Evaluation, evaluate
from pathloom.local.examples import Examples
from pathloom.local.generating import generate
from pathloom.local.policy import LearnedPolicy, Model, Policy, Rule
from pathloom.local.reading import read_examples
from pathloom.local.saving import load_model, save_model

__all__ = [
    "ClosedLoop",
    "Episode",
    "Evaluation",
    "Examples",
    "LearnedPolicy",
    "Model",
    "Policy",
    "Rule",
    "evaluate",
    "generate",
    "load_model",
    "read_examples",
    "save_model",
]
