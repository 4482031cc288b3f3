"""What ``policy train``, ``evaluate`` and ``drive`` share: where examples come from, and which policies are meant."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from pathloom.cli import asking
from pathloom.errors import ConfigError, PathloomError
from pathloom.naming import closest

if TYPE_CHECKING:
    from pathloom.kernel.component import Component
    from pathloom.local import ClosedLoop, Examples, Policy
    from pathloom.local.drivers.driver import Driver

C = TypeVar("C", bound="Component")

GENERATED = "generated"
DATA = (
    click.option(
        "--data", default=GENERATED, show_default=True, metavar="FILE|generated|openml[:WIDTH]",
        help="Examples: a file of the wall-following data, a simulated robot's, or those that OpenML has.",
    ),
    click.option("--examples", type=int, default=8000, show_default=True, help="How many are generated."),
    click.option("--expert", default="four-leaves", show_default=True, help="The rule that labels generated ones."),
    click.option("--where", default="rooms-30:4", show_default=True, metavar="NAME|FILE",
                 help="The map on which they are generated."),
    click.option("--distances", type=int, default=4, show_default=True, help="Distances of each: 2, 4 or 24."),
    click.option("--driven", is_flag=True, help="The expert drives about; else places are drawn at random."),
)  # fmt: skip
"""What is learned from."""

SET = click.option(
    "--set", "settings", multiple=True, metavar="NAME.FIELD=VALUE",
    help="Change a policy (rf.trees=50), a driver (avoiding.margin=0.1), or robot, sensing and hazards.",
)  # fmt: skip
SEED = click.option("--seed", type=int, default=0, show_default=True, help="An integer from 0 on.")


def seed_of(options: Mapping[str, Any]) -> int:
    """Return the seed, if it is one."""
    from pathloom.kernel.run import check_seed

    return check_seed(options["seed"])


def names_in(text: str | None, option: str) -> list[str]:
    """Return the names that stand in an option, each once."""
    names = [name.strip() for name in (text or "").split(",")]
    if not all(names):
        raise ConfigError(f"{option}: found none or an empty name, allowed names with commas between")
    for name in names:
        if names.count(name) > 1:
            raise ConfigError(f"{option}: found {name!r} twice, allowed each once")
    return names


def policy_of(name: str, where: str) -> "Policy":
    """Return the policy of a name; a dotted one is that of a classifier of scikit-learn."""
    from pathloom.kernel.compose import build
    from pathloom.kernel.registry import default_registry
    from pathloom.local import Policy
    from pathloom.local.classifiers import ALLOWED, Classifier

    if name.startswith("sklearn."):
        if name not in ALLOWED:
            raise ConfigError(f"{where}: found {name!r}, not among those allowed; {closest(name, ALLOWED)}")
        return Classifier(classifier=name)
    return build(Policy, name, default_registry(), where)


def examples_of(options: Mapping[str, Any], loop: "ClosedLoop", seed: int) -> "Examples":
    """Return the examples that options ask for."""
    from pathloom.local import read_examples
    from pathloom.local.reading import fetch_examples

    data = options["data"]
    if data == "openml" or data.startswith("openml:"):
        return fetch_examples(data)
    if data == GENERATED and not Path(data).is_file():
        return _generated(options, loop, seed)
    try:
        return read_examples(data)
    except PathloomError as error:
        if "no such file" in str(error) and (hint := closest(data, [GENERATED, "openml"])).startswith("did"):
            raise type(error)(f"{error}; {hint}") from error
        raise


def _generated(options: Mapping[str, Any], loop: "ClosedLoop", seed: int) -> "Examples":
    import numpy as np

    from pathloom.local import Rule, generate
    from pathloom.paths.maps import load_map

    expert = policy_of(options["expert"], "--expert")
    if not isinstance(expert, Rule):
        raise ConfigError(f"--expert: found {options['expert']!r}, which has to learn itself; allowed a rule")
    return generate(
        load_map(options["where"]),
        options["examples"],
        expert,
        rng=np.random.default_rng([seed, 3]),
        robot=loop.robot,
        sensing=loop.sensing,
        width=options["distances"],
        cell=loop.cell,
        driven=options["driven"],
    )


def changed(
    settings: Iterable[str], loop: "ClosedLoop", policies: dict[str, "Policy"], drivers: dict[str, "Driver"]
) -> "ClosedLoop":
    """Make the changes that ``--set`` asks for, of policies and drivers in place, and return the loop with its own."""
    from pathloom.kernel.component import parameters
    from pathloom.kernel.compose import override

    whole = [parameter.name for parameter in parameters(type(loop))]
    for setting in settings:
        path, equals, text = (part.strip() for part in setting.partition("="))
        if not equals or not all(path.split(".")):
            raise ConfigError(f"--set {setting}: found no NAME.FIELD or no '=', allowed NAME.FIELD=VALUE")
        value = asking.value_of(text)
        of_policy, of_driver = _named(path, policies), _named(path, drivers)
        try:
            if of_policy:
                policies[of_policy[0]] = _of_policy(policies[of_policy[0]], of_policy[1], value, text)
            elif of_driver:
                drivers[of_driver[0]] = override(drivers[of_driver[0]], of_driver[1], value)
            elif path.partition(".")[0] in whole:
                loop = override(loop, path, value)
            else:
                known = [*policies, *drivers, *whole]
                raise ConfigError(f"nothing here is called so; {closest(path.partition('.')[0], known)}")
        except ConfigError as error:
            raise ConfigError(f"--set {path}: {error}") from error
    return loop


def _named(path: str, known: Mapping[str, Any]) -> tuple[str, str] | None:
    """Return the name that a dotted path begins with, in full or as its last part, and the field that follows."""
    for name in sorted(known, key=len, reverse=True):
        for called in (name, name.rpartition(".")[2], name.rpartition("/")[2]):
            if path.startswith(f"{called}."):
                return name, path[len(called) + 1 :]
    return None


def _of_policy(policy: "Policy", field: str, value: Any, text: str) -> "Policy":
    """Return a policy with a field changed; what is none of a classifier's own is handed on to scikit-learn."""
    from dataclasses import replace

    from pathloom.kernel.component import parameters
    from pathloom.kernel.compose import override
    from pathloom.local.classifiers import Classifier

    if isinstance(policy, Classifier) and field not in [parameter.name for parameter in parameters(Classifier)]:
        policy = replace(policy, parameters=(*policy.parameters, f"{field}={text}"))
        policy.estimator(0)  # refuses what scikit-learn does not know
        return policy
    return override(policy, field, value)
