"""``pathloom policy evaluate``: how well policies predict what was right."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import asking, learning
from pathloom.errors import ConfigError

if TYPE_CHECKING:
    from rich.console import Console

    from pathloom.local import Evaluation, Examples, Policy

SCHEMA = "pathloom.policy/1"
PAPERS = "mnb,gnb,svm,knn,rf"
PLOTS = (".png", ".svg", ".pdf")


@click.command("evaluate")
@click.option("--policies", metavar="NAME,…", help=f"Policies, or classifiers by their dotted names; default {PAPERS}.")
@click.option("--model", metavar="FILE", help="Measure a trained model on all examples instead.")
@asking.options(*learning.DATA, learning.SET, learning.SEED)
@click.option(
    "--runs",
    type=click.IntRange(1, 1000),
    default=1,
    show_default=True,
    help="Hold-outs, drawn with the seeds from --seed on.",
)
@click.option("--curve", is_flag=True, help="Also learn from 50, 100, 200, … examples.")
@click.option(
    "--plot", metavar="FILE", help="Draw who takes what for what, and with --curve the learning curves: png, svg, pdf."
)
@asking.options(asking.DARK)
@click.option("--out", metavar="FILE", help="Write the JSON document.")
@asking.options(asking.JSON, asking.QUIET)
def command(**options: Any) -> None:
    """Measure policies on examples: hold-out and ten folds.

    Hold-out: three of ten examples are learned from, the others are for the test. Ten folds are made
    twice, in the order of the file and shuffled.
    """
    seed = learning.seed_of(options)
    asking.check_files(options, plot=PLOTS, out=None)
    if options["model"] is not None and options["policies"] is not None:
        raise ConfigError("--model and --policies: found both, allowed one of them")
    names = learning.names_in(PAPERS if options["policies"] is None else options["policies"], "--policies")

    from pathloom.cli import console
    from pathloom.local import ClosedLoop, evaluate, load_model
    from pathloom.result import versions

    policies = {} if options["model"] else {name: learning.policy_of(name, "--policies") for name in names}
    with console.compiling(quiet=options["quiet"]):
        loop = learning.changed(options["settings"], ClosedLoop(), policies, {})
        examples = learning.examples_of(options, loop, seed)
    if not options["quiet"]:
        for note in examples.notes:
            console.err().print(f"pathloom: {note}", soft_wrap=True)
    facts = {
        "schema": SCHEMA, "seed": seed,
        "data": {"name": examples.name, "sha256": examples.sha256, "rows": len(examples), "distances": examples.width},
        "versions": dict(versions()),
    }  # fmt: skip
    if options["model"] is not None:
        model, manifest = load_model(options["model"])
        _of_model(model, manifest, examples, facts, options)
        return
    found = {}
    with console.counting("policies", len(policies), quiet=options["quiet"]) as counted:
        for name, policy in policies.items():
            counted(name)
            found[name] = evaluate(policy, examples, seed=seed, draws=options["runs"], curve=options["curve"])
    document = {**facts, "policies": {name: _document(policies[name], it) for name, it in found.items()}}
    _give(document, options)
    if not options["as_json"]:
        _show(found, examples, console.out())
    if options["plot"]:
        _draw(found, examples, options)
    if not options["quiet"]:
        for name, it in found.items():
            for note in it.notes:
                console.err().print(f"pathloom: {name}: {note}", soft_wrap=True)


def _document(policy: "Policy", found: "Evaluation") -> dict[str, Any]:
    from pathloom.kernel.compose import freeze
    from pathloom.kernel.registry import default_registry

    return {"config": freeze(policy, default_registry()), **found.to_dict()}


def _of_model(
    model: Any, manifest: Mapping[str, Any], examples: "Examples", facts: dict[str, Any], options: Any
) -> None:
    """Measure a model that is there on all examples."""
    from pathloom.cli import console
    from pathloom.draw import save
    from pathloom.draw.local import confusion_figure
    from pathloom.local.evaluating import tried

    if model.width != examples.width:
        found = f"{examples.width} distances"
        raise ConfigError(
            f"{examples.name}: found {found}, allowed {model.width}, as {options['model']} was trained with"
        )
    measures = tried(model, examples)
    name = model.policy.name
    _give({**facts, "model": dict(manifest), "policies": {name: {"all": measures.to_dict()}}}, options)
    if not options["as_json"]:
        console.out().print(f"{options['model']}: {name}, trained on {manifest['examples']['name']}", soft_wrap=True)
        console.out().print(
            f"right on {100 * measures.accuracy:.2f} % of {len(examples)} examples, MCC {measures.mcc:.3f}"
        )
    if options["plot"]:
        save(
            confusion_figure({name: measures.confusion}, title=Path(examples.name).name, dark=options["dark"]),
            options["plot"],
        )


def _give(document: dict[str, Any], options: Mapping[str, Any]) -> None:
    from pathloom.cli import console
    from pathloom.files import replace

    if options["out"]:
        replace(options["out"], console.json_line(document).encode())
    if options["as_json"]:
        console.print_json(document)


def _show(found: Mapping[str, "Evaluation"], examples: "Examples", out: "Console") -> None:
    from rich.table import Table

    from pathloom.local.measuring import Measures

    first = next(iter(found.values()))
    out.print(f"{examples.name}: {len(examples)} examples of {examples.width} distances", soft_wrap=True)
    draws = len(first.holdouts)
    what = f"hold-out, {first.train} to learn from and {first.test} for the test" + (
        f", means of {draws} draws, the worst and the best in brackets" if draws > 1 else ""
    )
    out.print(f"{what}; ten folds as they stand in the file, and shuffled; in %")
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("policy")
    for head in ("accuracy", "precision", "recall", "F1", "MCC", "ten folds", "shuffled"):
        table.add_column(head, justify="right")
    for name, it in found.items():
        mean = Measures.mean(it.holdouts)
        folds = [Measures.mean(it.tenfold[order]).accuracy for order in ("file", "shuffled")]
        values = (mean.precision, mean.recall, mean.f1, mean.mcc, *folds)
        table.add_row(name, _accuracy(it), *(f"{100 * value:.1f}" for value in values))
    out.print(table)


def _accuracy(found: "Evaluation") -> str:
    """Return the mean accuracy of all hold-outs, and that of the worst and the best where there are several."""
    each = [100 * one.accuracy for one in found.holdouts]
    mean = f"{sum(each) / len(each):.1f}"
    return f"{mean} [{min(each):.1f}, {max(each):.1f}]" if len(each) > 1 else mean


def _draw(found: Mapping[str, "Evaluation"], examples: "Examples", options: Mapping[str, Any]) -> None:
    from pathloom.draw import save
    from pathloom.draw.local import confusion_figure

    curves = {name: it.curve for name, it in found.items() if it.curve}
    confusions = {name: it.holdouts[0].confusion for name, it in found.items()}
    save(
        confusion_figure(confusions, curves=curves, title=Path(examples.name).name, dark=options["dark"]),
        options["plot"],
    )
