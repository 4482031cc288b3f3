"""``pathloom plugins``: list and show what is installed."""

import inspect
import warnings
from typing import TYPE_CHECKING, Any

import click

from pathloom.cli import Group, asking
from pathloom.cli.plugins_check import check
from pathloom.cli.plugins_new import new
from pathloom.errors import ConfigError, PluginWarning

if TYPE_CHECKING:
    from rich.console import Console

    from pathloom.kernel.component import Parameter
    from pathloom.kernel.registry import Entry, Registry


@click.group("plugins", cls=Group)
def command() -> None:
    """List, show, cite, check and begin plugins."""


command.add_command(check)
command.add_command(new)


@command.command("list")
@click.option("--kind", help="Only components of one kind, e.g. selection.")
@asking.JSON
def list_(kind: str | None, as_json: bool) -> None:
    """List plugins and components, broken plugins with their cause."""
    from pathloom.cli import console
    from pathloom.kernel.planner import Planner
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
            "source": e.component.source or e.component.reference,
            "plugin": e.source.namespace,
            "distribution": f"{e.source.distribution} {e.source.version}".strip(),
            **({"fidelity": e.component.fidelity} if issubclass(e.component, Planner) else {}),
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
    from pathloom.kernel.component import meanings, parameters
    from pathloom.kernel.compose import freeze
    from pathloom.kernel.planner import Planner

    component = entry.component
    about = meanings(component)
    document: dict[str, Any] = {
        "name": entry.name,
        "kind": component.kind,
        "about": inspect.getdoc(component) or "",
        "source": component.source,
        "plugin": str(entry.source),
        "works_on": component.works_on,
        "needs": sorted(component.needs),
        "gives": sorted(component.gives),
        "breaks": sorted(component.breaks),
        "reference": component.reference,
        "bibtex": component.bibtex,
        "parameters": [_parameter(p, about.get(p.name, ""), registry) for p in parameters(component)],
    }
    if issubclass(component, Planner):
        document |= {"fidelity": component.fidelity, "assumptions": list(component.assumptions)}
        if not any(p.required for p in parameters(component)):
            document["config"] = freeze(component(), registry)
    return document


def _parameter(parameter: "Parameter", about: str, registry: "Registry") -> dict[str, Any]:
    """Return all that a component declares of a parameter: ``type`` is a JSON schema, or the kind that a slot takes."""
    from pathloom.schema import schema_of

    return {
        "name": parameter.name,
        "type": schema_of(parameter),
        "allowed": parameter.allowed,
        "unit": parameter.unit,
        "default": "needed" if parameter.required else _default(parameter.default, registry),
        "about": about,
    }


def _print(document: dict[str, Any], out: "Console") -> None:
    from rich.table import Table
    from rich.text import Text

    out.print(Text.assemble((document["name"], "bold"), f", {document['kind']}, {document['plugin']}"))
    out.print(document["about"])
    for head, text in (
        ("Source", document["source"]),
        ("Reference", document["reference"]),
        ("Works on", document["works_on"]),
        ("Needs", ", ".join(document["needs"])),
        ("Gives", ", ".join(document["gives"])),
        ("May break", ", ".join(document["breaks"])),
        ("Fidelity", document.get("fidelity") if document["reference"] else ""),
    ):
        if text:
            out.print(f"{head}: {text}")
    for assumption in document.get("assumptions", ()):
        out.print(f"  - {assumption}")
    if document["parameters"]:
        table = Table(box=None, pad_edge=False)
        for head in ("parameter", "allowed", "unit", "default", "meaning"):
            table.add_column(head, no_wrap=head in ("parameter", "unit"))
        for row in document["parameters"]:
            table.add_row(row["name"], row["allowed"], row["unit"], row["default"], row["about"])
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

    from pathloom.cli import console
    from pathloom.config import Config, read_config
    from pathloom.kernel.citing import works_of
    from pathloom.kernel.compose import compose

    used = read_config(config) if Path(config).suffix == ".toml" else Config(planner={"use": config})
    parts = [compose(used.planner), *used.front.rivals(), *filter(None, [used.smooth])]
    entries = [work.bibtex.rstrip() + "\n" for work in works_of(parts) if work.bibtex]
    click.echo("\n".join(entries), nl=False)
    if not entries:
        console.err().print(f"pathloom: {config}: found nothing that names a publication", soft_wrap=True)


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
