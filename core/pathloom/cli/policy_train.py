"""``pathloom policy train``: learn from examples, and keep what was learned."""

from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import asking, learning
from pathloom.errors import ConfigError

if TYPE_CHECKING:
    from pathloom.local import Model

LEAVES = 16
"""A tree of at most so many leaves is shown."""


@click.command("train")
@click.option(
    "--policy",
    default="rf",
    show_default=True,
    metavar="NAME",
    help="A policy, or a classifier such as sklearn.tree.DecisionTreeClassifier.",
)
@asking.options(*learning.DATA, learning.SET, learning.SEED)
@click.option("--out", metavar="FILE", help="Where the model is kept, e.g. rf.skops.")
@asking.options(asking.JSON, asking.QUIET)
def command(**options: Any) -> None:
    """Train a policy on all examples, and keep the model with what it was trained on.

    A model is a skops file with a manifest; loading one runs no code that is in it.
    """
    seed = learning.seed_of(options)
    if options["out"] is None:
        raise ConfigError("--out: found none, allowed a file such as rf.skops, in which the model is kept")
    asking.check_files(options, out=None)
    import numpy as np

    from pathloom.cli import console
    from pathloom.local import ClosedLoop, Model, save_model
    from pathloom.local.evaluating import tried

    policies = {options["policy"]: learning.policy_of(options["policy"], "--policy")}
    with console.compiling(quiet=options["quiet"]):
        loop = learning.changed(options["settings"], ClosedLoop(), policies, {})
        examples = learning.examples_of(options, loop, seed)
    if not options["quiet"]:
        for note in examples.notes:
            console.err().print(f"pathloom: {note}", soft_wrap=True)
    (policy,) = policies.values()
    model = policy.trained(examples, np.random.default_rng([seed, 1]))
    if not isinstance(model, Model):
        raise ConfigError(f"--policy: found {options['policy']!r}, a rule that has nothing to learn")
    manifest = save_model(model, options["out"], examples, seed)
    accuracy = tried(model, examples).accuracy
    if options["as_json"]:
        console.print_json({**manifest, "file": options["out"], "accuracy_on_its_examples": accuracy})
        return
    out = console.out()
    out.print(
        f"{options['out']}: {policy.name}, trained on {len(examples)} examples of {model.width} distances",
        soft_wrap=True,
    )
    out.print(f"{examples.name}, sha256 {examples.sha256[:16]}…", soft_wrap=True)
    for line in _rules(model):
        out.print(line, soft_wrap=True)
    out.print(f"right on {100 * accuracy:.1f} % of them; on others: pathloom policy evaluate", soft_wrap=True)


def _rules(model: "Model") -> list[str]:
    """Return the lines of a small decision tree; none for any other classifier."""
    from sklearn.tree import DecisionTreeClassifier, export_text

    from pathloom.local.actions import NAMES
    from pathloom.local.sectors import ARCS, SENSORS

    tree = model.classifier
    if not isinstance(tree, DecisionTreeClassifier) or tree.get_n_leaves() > LEAVES:
        return []
    features = list(ARCS) if model.width <= len(ARCS) else [f"sensor {k}" for k in range(1, SENSORS + 1)]
    classes = [NAMES[action] for action in tree.classes_]
    shown = export_text(tree, feature_names=features[: model.width], class_names=classes, decimals=3)
    return list(shown.splitlines())
