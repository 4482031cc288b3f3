"""Scaffold: a complete package for a plugin, to begin with. Its templates lie beside this module."""

import re
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path

from pathloom.errors import ConfigError
from pathloom.files import make_folder, replace
from pathloom.kernel.registry import default_registry

LONGEST = 30
"""Letters of a name."""
SUFFIX = ".j2"
PACKAGE = "PACKAGE"
"""Stands for the name of the Python package in the name of a template's folder."""


def write_package(name: str, into: Path) -> Path:
    """Write the package of a plugin into a new folder of that name, and return it.

    Parameters
    ----------
    name
        The plugin's namespace: ``acme`` for components that are called ``acme/nudge``.
    into
        The folder in which the new one is made.

    Raises
    ------
    ConfigError
        If the name cannot be that of a plugin, is taken, or the folder is there already.
    MapError
        If the folder cannot be written.
    """
    check_name(name)
    folder = into / name
    if folder.exists() or folder.is_symlink():
        raise ConfigError(f"{folder}: found what is there already, allowed a new folder")
    make_folder(folder)
    words = _words(name)
    for place, text in rendered(words).items():
        for parent in reversed(Path(place).parents[:-1]):
            make_folder(folder / parent)
        replace(folder / place, text.encode())
    return folder


def check_name(name: str) -> None:
    """Refuse a name that no plugin can have, or that another one has.

    Raises
    ------
    ConfigError
        What is wrong with it, and what was probably meant.
    """
    allowed = "small letters, digits and single hyphens, a letter first"
    plain = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")
    bare = plain.removeprefix("pathloom").strip("-")
    if name.startswith("pathloom"):
        raise ConfigError(f"NAME: found {name!r}, allowed a name that does not begin with 'pathloom'{_meant(bare)}")
    if not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", name):
        raise ConfigError(f"NAME: found {name!r}, allowed {allowed}{_meant(bare)}")
    if len(name) > LONGEST:
        raise ConfigError(f"NAME: found {len(name)} letters, allowed {LONGEST}")
    registry = default_registry()
    if name in registry.namespaces:
        raise ConfigError(f"NAME: found {name!r}, allowed one that is not taken: it is that of {registry.source(name)}")


def rendered(words: dict[str, str]) -> dict[str, str]:
    """Return the files of a package by their place in it."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    templates = Environment(  # noqa: S701 - Python and TOML, where nothing is to be escaped
        loader=PackageLoader("pathloom.scaffold"), undefined=StrictUndefined, keep_trailing_newline=True,
        variable_start_string="<<", variable_end_string=">>",
    )  # fmt: skip
    places = _places(files("pathloom.scaffold") / "templates")
    return {
        place.removesuffix(SUFFIX).replace(PACKAGE, words["package"]): templates.get_template(place).render(words)
        for place in sorted(places)
    }


def _places(folder: Traversable, prefix: str = "") -> list[str]:
    found: list[str] = []
    for entry in folder.iterdir():
        inner = f"{prefix}{entry.name}"
        if entry.is_dir():
            found += _places(entry, f"{inner}/")
        elif entry.name.endswith(SUFFIX):
            found.append(inner)
    return found


def _words(name: str) -> dict[str, str]:
    """Return what the templates ask for."""
    from importlib.metadata import version

    return {
        "name": name,
        "package": f"pathloom_{name.replace('-', '_')}",
        "distribution": f"pathloom-{name}",
        "pathloom": ".".join(version("pathloom").split(".")[:2]),
    }


def _meant(name: str) -> str:
    return f"; did you mean {name!r}?" if re.match("[a-z]", name) else ""
