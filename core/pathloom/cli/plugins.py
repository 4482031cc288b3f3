"""``pathloom plugins``: list and show what is installed."""

import inspect
import warnings
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import Group, asking
from pathloom.cli.plugins_check import check
from pathloom.errors import ConfigError, PluginWarning

if TYPE_CHECKING:
    from rich.console import Console

    from pathloom.kernel.registry import Entry, Registry


@click.group("plugins", cls=Group)
def command() -> None:
    """List and show plugins and their components."""


command.add_command(check)


@command.command("list")
@click.option("--kind", help="Only components of one kind, e.g. selection.")
@asking.JSON
def list_(kind: str | None, as_json: bool) -> None:
    """List plugins and components, broken plugins with their cause."""
    from pathloom.cli import console
    from pathloom.kernel.registry import default_registry
    from pathloom.naming import closest

    registry = default_registry()
    with warnings.catch_warnings(record=True) as remarks:
        warnings.simplefilter("always", PluginWarning)
        broken = registry.broken()
    entries = list(registry.all_entries())
    kinds = {e.component.kind for e in entries}
    if kind is not None and kind not in kinds:
        raise ConfigError(f"--kind: no component is of the kind {kind!r}; {closest(kind, kinds)}")
    rows = [
        {
            "kind": e.component.kind,
            "name": e.name,
            "about": _about(e.component),
            "source": e.component.source or getattr(e.component, "reference", ""),
            "plugin": e.source.namespace,
            "distribution": f"{e.source.distribution} {e.source.version}".strip(),
        }
        for e in entries
        if kind in (None, e.component.kind)
    ]
    rows.sort(key=lambda row: (row["kind"], row["name"]))
    if as_json:
        console.print_json(
            {
                "components": rows,
                "broken": {k: str(v) for k, v in broken.items()},
                "remarks": [str(remark.message) for remark in remarks],
            }
        )
        return
    console.out().print("\n".join(_listed(rows, console.out().width)), soft_wrap=True)
    for namespace in registry.namespaces:
        source = registry.source(namespace)
        if not source.ours and namespace not in broken:
            console.out().print(f"{source}")
    for remark in remarks:
        console.out().print(f"remark: {remark.message}", style="yellow", soft_wrap=True)
    for cause in broken.values():
        console.out().print(f"broken: {cause}", style="red", soft_wrap=True)


def _listed(rows: list[dict[str, Any]], width: int) -> list[str]:
    """Return the lines of a table of kinds, names and what they are: rich's own takes a third of a second for 700."""
    from textwrap import wrap

    heads = {"kind": "kind", "name": "name", "about": "what it is"}
    kinds, names = (max(len(row[column]) for row in (heads, *rows)) for column in ("kind", "name"))
    lines, before = [], None
    for row in (heads, *rows):
        kind = row["kind"] if row["kind"] != before else ""
        first, *others = wrap(row["about"], max(width - kinds - names - 2, 20)) or [""]
        lines.append(f"{kind:{kinds}} {row['name']:{names}} {first}".rstrip())
        lines += [" " * (kinds + names + 2) + line for line in others]
        before = row["kind"]
    return lines


@command.command("show")
@click.argument("name")
@asking.JSON
def show(name: str, as_json: bool) -> None:
    """Show a component: what it is, its source, and its parameters with defaults and ranges."""
    from pathloom.cli import console
    from pathloom.kernel.registry import default_registry

    registry = default_registry()
    documents = [_document(entry, registry) for entry in _called(name, registry)]
    if as_json:
        console.print_json(documents[0] if len(documents) == 1 else documents)
        return
    for document in documents:
        _print(document, console.out())


def _called(name: str, registry: "Registry") -> list["Entry"]:
    """Return the components of a full or a bare name, or all of the plugin of that name."""
    from pathloom.naming import closest

    entries = list(registry.all_entries())
    found = [e for e in entries if e.name == name] or [e for e in entries if e.component.name == name]
    if found:
        return found
    if name in (broken := registry.broken()):
        raise broken[name]
    if name in registry.namespaces:
        return registry.entries(name)
    raise ConfigError(f"no component is called {name!r}; {closest(name, (e.name for e in entries))}")


def _document(entry: "Entry", registry: "Registry") -> dict[str, Any]:
    """Return all that a component declares of itself."""
    from pathloom.kernel.component import parameters
    from pathloom.kernel.compose import freeze
    from pathloom.kernel.planner import Planner

    component = entry.component
    meanings = _field_docs(component)
    document: dict[str, Any] = {
        "name": entry.name,
        "kind": component.kind,
        "about": inspect.getdoc(component) or "",
        "source": component.source,
        "plugin": str(entry.source),
        "needs": sorted(component.needs),
        "parameters": [
            {
                "name": parameter.name,
                "allowed": parameter.allowed,
                "default": "needed" if parameter.required else _default(parameter.default, registry),
                "about": meanings.get(parameter.name, ""),
            }
            for parameter in parameters(component)
        ],
    }
    if issubclass(component, Planner):
        document |= {
            "reference": component.reference,
            "fidelity": component.fidelity,
            "assumptions": list(component.assumptions),
        }
        if not any(p.required for p in parameters(component)):
            document["config"] = freeze(component(), registry)
    return document


def _print(document: dict[str, Any], out: "Console") -> None:
    from rich.table import Table
    from rich.text import Text

    out.print(Text.assemble((document["name"], "bold"), f", {document['kind']}, {document['plugin']}"))
    out.print(document["about"])
    if document["source"]:
        out.print(f"Source: {document['source']}")
    if document.get("reference"):
        out.print(f"Reference: {document['reference']}")
        out.print(f"Fidelity: {document['fidelity']}")
        for assumption in document["assumptions"]:
            out.print(f"  - {assumption}")
    if document["parameters"]:
        table = Table(box=None, pad_edge=False)
        for head in ("parameter", "allowed", "default", "meaning"):
            table.add_column(head)
        for row in document["parameters"]:
            table.add_row(row["name"], row["allowed"], row["default"], row["about"])
        out.print(table)


@command.command("schema")
def schema() -> None:
    """Print the JSON schema of the config, from which editors complete."""
    import json

    from pathloom.kernel.registry import default_registry
    from pathloom.schema import schema_of_config

    click.echo(json.dumps(schema_of_config(default_registry()), indent=2))


@command.command("cite")
@click.argument("config")
def cite(config: str) -> None:
    """Print BibTeX entries of the planner and the parts that a config (or a planner's name) uses."""
    from pathlib import Path

    from pathloom.config import read_config
    from pathloom.kernel.citing import works_of
    from pathloom.kernel.compose import compose

    planner = compose(read_config(config).planner if Path(config).suffix == ".toml" else config)
    click.echo("\n".join(work.bibtex for work in works_of([planner]) if work.bibtex), nl=False)


def _about(component: type) -> str:
    return (inspect.getdoc(component) or "").partition("\n")[0]


def _default(value: Any, registry: Any) -> str:
    from pathloom.kernel.component import Component

    if value is None:
        return "none"
    if isinstance(value, Component):
        return str(registry.name_of(type(value)))
    if isinstance(value, tuple):
        return ", ".join(_default(getattr(v, "objective", v), registry) for v in value) or "none"
    return str(value)


def _field_docs(component: type) -> dict[str, str]:
    """Return the docstrings that stand below the fields of a class and its bases."""
    import ast
    import textwrap
    from itertools import pairwise

    docs: dict[str, str] = {}
    for base in reversed(component.__mro__):
        try:
            tree = ast.parse(textwrap.dedent(inspect.getsource(base))).body[0]
        except (OSError, TypeError, SyntaxError):
            continue
        body = tree.body if isinstance(tree, ast.ClassDef) else []
        for statement, text in pairwise(body):
            if (
                isinstance(statement, ast.AnnAssign)
                and isinstance(statement.target, ast.Name)
                and isinstance(text, ast.Expr)
                and isinstance(text.value, ast.Constant)
            ):
                docs[statement.target.id] = " ".join(str(text.value.value).split())
    return docs
