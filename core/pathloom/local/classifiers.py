"""Any classifier of scikit-learn as a policy, by its dotted name."""

from dataclasses import dataclass
from importlib import import_module
from typing import Any, ClassVar

from pathloom.errors import ConfigError
from pathloom.local.policy import LearnedPolicy, first_line
from pathloom.naming import closest

ALLOWED = frozenset({
    "sklearn.discriminant_analysis.LinearDiscriminantAnalysis",
    "sklearn.discriminant_analysis.QuadraticDiscriminantAnalysis",
    "sklearn.dummy.DummyClassifier",
    "sklearn.ensemble.AdaBoostClassifier",
    "sklearn.ensemble.ExtraTreesClassifier",
    "sklearn.ensemble.GradientBoostingClassifier",
    "sklearn.ensemble.HistGradientBoostingClassifier",
    "sklearn.ensemble.RandomForestClassifier",
    "sklearn.linear_model.LogisticRegression",
    "sklearn.linear_model.Perceptron",
    "sklearn.linear_model.RidgeClassifier",
    "sklearn.linear_model.SGDClassifier",
    "sklearn.naive_bayes.BernoulliNB",
    "sklearn.naive_bayes.ComplementNB",
    "sklearn.naive_bayes.GaussianNB",
    "sklearn.naive_bayes.MultinomialNB",
    "sklearn.neighbors.KNeighborsClassifier",
    "sklearn.neighbors.NearestCentroid",
    "sklearn.neural_network.MLPClassifier",
    "sklearn.svm.LinearSVC",
    "sklearn.svm.NuSVC",
    "sklearn.svm.SVC",
    "sklearn.tree.DecisionTreeClassifier",
    "sklearn.tree.ExtraTreeClassifier",
})  # fmt: skip
"""A name is imported only if it stands here."""


@dataclass(frozen=True, kw_only=True)
class Classifier(LearnedPolicy):
    """A classifier of scikit-learn, by its dotted name."""

    source: ClassVar[str] = "F. Pedregosa et al. (2011), J. Mach. Learn. Res. 12, 2825"

    classifier: str = "sklearn.tree.DecisionTreeClassifier"
    """Its dotted name, one of those allowed."""
    parameters: tuple[str, ...] = ()
    """``NAME=VALUE`` in TOML each, such as ``max_depth=3``; the others are scikit-learn's defaults."""
    scaled: bool = False
    """Scale every distance to mean 0 and variance 1 beforehand, as networks and linear models like it."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.classifier not in ALLOWED:
            raise ConfigError(
                f"{self.name}: classifier: found {self.classifier!r}; {closest(self.classifier, ALLOWED)}"
            )
        for text in self.parameters:
            _parameter(text)

    def estimator(self, seed: int) -> Any:
        module, _, name = self.classifier.rpartition(".")
        found = getattr(import_module(module), name)()
        known = found.get_params()
        given = dict(_parameter(text) for text in self.parameters)
        for key in given:
            if key not in known:
                raise ConfigError(f"{self.classifier}: has no parameter {key!r}; {closest(key, known)}")
        try:
            found.set_params(**({"random_state": seed} if "random_state" in known else {}), **given)
        except (ValueError, TypeError) as error:
            raise ConfigError(f"{self.classifier}: {first_line(error)}") from error
        if not self.scaled:
            return found
        from sklearn.pipeline import make_pipeline
        from sklearn.preprocessing import StandardScaler

        return make_pipeline(StandardScaler(), found)


def _parameter(text: str) -> tuple[str, Any]:
    """Return the name and the value that a text such as ``max_depth=3`` gives; a bare word is a text."""
    import tomllib

    name, equals, value = (part.strip() for part in text.partition("="))
    if not name.isidentifier() or not equals or name == "random_state":
        raise ConfigError(f"parameters: found {text!r}, allowed NAME=VALUE, and not the seed")
    try:
        return name, tomllib.loads(f"value = {value}")["value"]
    except (ValueError, RecursionError):
        return name, value
