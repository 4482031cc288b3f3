"""Preference: who is better is favoured, never the other way round."""

from typing import Any

import numpy as np

from pathloom.errors import PathloomError
from pathloom.kernel.evaluation import Fitness
from pathloom.kernel.operators import Selection
from pathloom.testing.check import expect, promise


@promise("favours-the-fit", Selection)
def favours_the_fit(component: Any) -> None:
    """Those who are selected are on average no less fit than all."""
    fitness = np.linspace(0.1, 1.0, 300)
    found = fitness[component.select(fitness.copy(), 300, np.random.default_rng(0))].mean()
    expect(found >= fitness.mean(), f"expected a mean fitness of {fitness.mean():.3f} or more; found {found:.3f}")


@promise("less-is-fitter", Fitness)
def less_is_fitter(component: Any) -> None:
    """Who has the smaller value in every objective is no less fit: values are minimised."""
    for m in (1, 2, 3):
        values = np.sort(np.random.default_rng(m).uniform(1.0, 9.0, (20, m)), axis=0)
        try:
            fitness = np.asarray(component.combine(values, np.ones(m)))
        except PathloomError:
            continue  # it says that it is not for so many
        falling = (np.diff(fitness) <= 1e-12 * np.abs(fitness[1:])).all()
        expect(falling, f"expected fitness that falls as all values rise; found {fitness.tolist()}")


CHECKS = (favours_the_fit, less_is_fitter)
