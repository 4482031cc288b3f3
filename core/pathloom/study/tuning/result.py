"""What tuning found, to be read, drawn and written down."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.files import FilePath
from pathloom.kernel.evaluation import Floats
from pathloom.study import Study
from pathloom.study.statistics.summary import Summary
from pathloom.study.tuning.factors import Experiment
from pathloom.study.tuning.model import Model
from pathloom.study.tuning.response import Response

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA = "pathloom.tune/1"
NAMED = 6
"""Confounded pairs that are named one by one."""


@dataclass(frozen=True)
class Tuning:
    """A designed experiment over a planner's parameters, what it says, and whether that was confirmed."""

    base: str
    """Name of the planner as it is."""
    experiment: Experiment
    settings: tuple[str, ...]
    """Names of the settings' variants, in the order of the design."""
    response: Response
    model: Model
    base_mean: float | None
    """Mean response of the base, on the same maps and seeds."""
    study: Study
    confirmation: Summary | None = None
    """The base against the predicted best, with fresh seeds; None if they are the same, or none was asked for."""
    confirmed: dict[str, float] | None = None
    """Mean response of both in these runs, and the difference's standard error."""

    @property
    def optimum(self) -> dict[str, Any]:
        """The setting that is predicted best, by parameter."""
        return self.model.optimum

    @property
    def means(self) -> Floats:
        """(settings,), mean response of each."""
        return np.asarray(self.response.trials.mean(axis=1))

    def sentences(self) -> Iterator[str]:
        """Yield what was tried, what came of it, and what the design cannot tell."""
        yield from _Telling(self).all()

    def plot(self, file: FilePath | None = None, *, dark: bool = False) -> "Figure":
        """Draw the main effects, and save them where a file is named."""
        from pathloom.draw.saving import save
        from pathloom.draw.study import Effect, Sheet, main_effects_figure

        scale = 100.0 if self.response.metric.unit == "%" else 1.0
        found = zip(self.experiment.factors, self.model.levels.means, self.model.levels.errors, strict=True)
        effects = [Effect(f.path, [str(v) for v in f.values], m * scale, e * scale) for f, m, e in found]
        sheet = Sheet(
            title=f"Main effects on {self.base}",
            caption=f"{self.experiment.array}, {len(self.settings)} settings; bars are standard errors",
            dark=dark,
        )
        mean = self.model.levels.mean * scale
        figure = main_effects_figure(effects, mean=mean, y_label=self.response.metric.head, sheet=sheet)
        if file is not None:
            save(figure, file)
        return figure

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document, schema ``pathloom.tune/1``."""
        fitted, names = self.model, [factor.path for factor in self.experiment.factors]
        effects = [
            {
                "factor": factor.path,
                "values": list(factor.values),
                "means": means.tolist(),
                "errors": _plain(errors),
                "slope": slope,
                "slope_error": _known(error),
                "p": _known(p),
            }
            for factor, means, errors, slope, error, p in zip(
                self.experiment.factors,
                fitted.levels.means,
                fitted.levels.errors,
                fitted.linear.slopes.tolist(),
                fitted.linear.errors.tolist(),
                fitted.p.tolist(),
                strict=True,
            )
        ]
        return {
            "schema": SCHEMA,
            "base": self.base,
            "array": self.experiment.array,
            "response": self.response.metric.name,
            "by": fitted.by,
            "settings": [
                {"values": self.experiment.setting(row), "variant": name, "mean": mean}
                for row, name, mean in zip(
                    self.experiment.levels.tolist(), self.settings, self.means.tolist(), strict=True
                )
            ],
            "trials": self.response.trials.shape[1],
            "penalised": self.response.penalised,
            "mean": fitted.levels.mean,
            "spread": _known(fitted.levels.spread),
            "effects": effects,
            "aliases": {
                "inseparable": [[names[a], names[b]] for a, b in fitted.inseparable],
                "correlated": [[names[a], names[b], r] for a, b, r in fitted.correlated],
                "confounded": [
                    {"factor": names[it.factor], "pair": [names[i] for i in it.pair], "share": it.share}
                    for it in fitted.confounded
                ],
            },
            "optimum": self.optimum,
            "predicted": fitted.predicted,
            "predicted_error": _known(fitted.error),
            "base_mean": self.base_mean,
            "confirmed": self.confirmed,
            "confirmation": None if self.confirmation is None else self.confirmation.to_dict(),
            "sentences": list(self.sentences()),
        }


class _Telling:
    """The sentences of one tuning."""

    def __init__(self, tuning: Tuning) -> None:
        self.it = tuning
        self.metric = tuning.response.metric
        self.names = [factor.path for factor in tuning.experiment.factors]

    def all(self) -> Iterator[str]:
        it, fitted = self.it, self.it.model
        count = it.response.trials.shape[1]
        array = "all combinations" if it.experiment.array == "full" else f"the array {it.experiment.array}"
        yield (
            f"{len(it.settings)} settings ({array}), {count} runs of each on {_maps(it.response.maps)}; response: "
            f"{self.metric.label}, mean {self.metric.show(fitted.levels.mean)}, standard deviation of single runs "
            f"{self._width(fitted.levels.spread)}."
        )
        if it.response.penalised:
            yield f"{it.response.penalised} runs without a value count as the worst of their map."
        if it.response.left_out:
            yield f"{_maps(it.response.left_out)} left out, as the response is not known there."
        for place in range(len(self.names)):
            yield self._factor(place)
        yield from self._aliasing()
        chosen = ", ".join(f"{name}={value}" for name, value in it.optimum.items())
        how = {"levels": "mean responses of levels", "ols": "linear model", "paper": "linear model, paper's divisor"}
        against = "" if it.base_mean is None else f"; the base has {self.metric.show(it.base_mean)}"
        yield (
            f"Predicted best ({how[fitted.by]}): {chosen}, with {self.metric.show(fitted.predicted)} "
            f"(standard error {self._width(fitted.error)}){against}."
        )
        yield from self._confirmation()

    def _factor(self, place: int) -> str:
        means = self.it.model.levels.means[place]
        best = int(np.argmin(means) if self.metric.sign > 0 else np.argmax(means))
        value = self.it.experiment.factors[place].values[best]
        apart = f"{self.metric.number(float(np.ptp(means)))} {self.metric.apart}".strip()
        p = self.it.model.p[place]
        if not np.isfinite(p):
            return f"{self.names[place]}: levels lie {apart} apart, best at {value}; no repeated trials, so no test."
        shown = f"p = {p:.2g} after Holm"
        if p < 0.05:
            return f"{self.names[place]}: best at {value}, levels lie {apart} apart ({shown})."
        return f"{self.names[place]}: no effect shown ({shown}); levels lie {apart} apart, best at {value}."

    def _aliasing(self) -> Iterator[str]:
        fitted, names = self.it.model, self.names
        for a, b in fitted.inseparable:
            yield f"{names[a]} and {names[b]} always change together: their effects cannot be told apart."
        for a, b, share in fitted.correlated:
            if (a, b) not in fitted.inseparable:
                yield f"{names[a]} and {names[b]} go together in part (correlation {share:.2f})."
        if not fitted.confounded:
            if len(names) > 2:
                yield "No main effect is mixed up with the joint effect of two others."
            return
        told = [
            f"{names[it.factor]} with {names[it.pair[0]]} × {names[it.pair[1]]} ({it.share:.0%})"
            for it in sorted(fitted.confounded, key=lambda it: -it.share)[:NAMED]
        ]
        more = len(fitted.confounded) - len(told)
        rest = f" and {more} more" if more > 0 else ""
        yield f"Main effects are mixed up with joint effects of two factors, if there are any: {'; '.join(told)}{rest}."

    def _confirmation(self) -> Iterator[str]:
        it = self.it
        if it.confirmation is None or it.confirmed is None:
            return
        best, base = it.confirmed["optimum"], it.confirmed["base"]
        error = float(np.hypot(it.confirmed["error"], np.nan_to_num(it.model.error)))
        agrees = abs(best - it.model.predicted) <= 2.0 * error
        yield (
            f"Confirmation with fresh seeds: {self.metric.show(best)} against {self.metric.show(base)} of the base, "
            f"{'in keeping with' if agrees else 'other than'} the prediction."
        )
        yield from (v.text for v in it.confirmation.verdicts if v.metric in ("success", self.metric.name))

    def _width(self, value: float) -> str:
        return f"{self.metric.number(value)} {self.metric.apart}".strip() if np.isfinite(value) else "unknown"


def _maps(count: int) -> str:
    return "1 map" if count == 1 else f"{count} maps"


def _known(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def _plain(values: Floats) -> list[float | None]:
    return [_known(value) for value in values.tolist()]
