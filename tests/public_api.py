"""What is public, in words: every name with its signature, read from the source, so that all versions of Python agree.

``python tests/public_api.py`` writes the list anew, after a change that is meant; what it changes belongs in the
changelog.
"""

import ast
import importlib
import inspect
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

LIST = Path(__file__).with_suffix(".txt")
MODULES = ("pathloom", "pathloom.testing")


def listed() -> str:
    """Return all that is public, a line each."""
    from pathloom.kernel.plugins import Hooks

    lines = []
    for name in MODULES:
        module = importlib.import_module(name)
        for public in sorted(module.__all__):
            lines += described(f"{name}.{public}", getattr(module, public), home_of(module, public), public)
    lines += described("hooks", Hooks, sys.modules[Hooks.__module__], "Hooks")
    return "\n".join(lines) + "\n"


def home_of(module: ModuleType, name: str) -> ModuleType:
    """Return the module in which a public name is written."""
    if name in (known := getattr(module, "_FROM", {})):
        return importlib.import_module(f"pathloom.{known[name]}")
    return sys.modules.get(getattr(getattr(module, name), "__module__", ""), module)


def described(label: str, thing: Any, home: ModuleType, name: str) -> Iterator[str]:
    if inspect.isclass(thing):
        yield f"class {label}({', '.join(base.__name__ for base in thing.__bases__)})"
        for node in sorted(members_of(thing), key=lambda node: (isinstance(node, ast.FunctionDef), name_of(node))):
            yield f"    {written(node)}"
        return
    for node in tree_of(home).body:
        if isinstance(node, (ast.FunctionDef, ast.Assign, ast.AnnAssign)) and name_of(node) == name:
            yield f"{label}: {written(node)}"
            return
    yield f"{label}: {type(thing).__name__}"


def members_of(kind: type) -> list[ast.stmt]:
    """Return the public members that a class declares, with those of bases that are not public themselves."""
    import pathloom

    found: dict[str, ast.stmt] = {}
    for base in reversed(kind.__mro__):
        ours = base.__module__.partition(".")[0] == "pathloom"
        if ours and (base is kind or base.__name__ not in pathloom.__all__):
            for node in class_in(tree_of(sys.modules[base.__module__]), base.__qualname__).body:
                if isinstance(node, (ast.FunctionDef, ast.Assign, ast.AnnAssign)) and is_public(name_of(node)):
                    found[name_of(node)] = node
    return list(found.values())


def is_public(name: str) -> bool:
    return not name.startswith("_") or name in ("__init__", "__call__")


def name_of(node: ast.stmt) -> str:
    if isinstance(node, ast.FunctionDef):
        return node.name
    target = node.targets[0] if isinstance(node, ast.Assign) else node.target
    return ast.unparse(target)


def written(node: ast.stmt) -> str:
    """Return a declaration in one line."""
    if not isinstance(node, ast.FunctionDef):
        return ast.unparse(node)
    marks = [ast.unparse(mark) for mark in node.decorator_list]
    shown = "".join(f"@{mark} " for mark in marks if not mark.startswith(("kernel", "part")))
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    return f"{shown}def {node.name}({ast.unparse(node.args)}){returns}"


def class_in(tree: ast.Module, name: str) -> ast.ClassDef:
    return next(node for node in tree.body if isinstance(node, ast.ClassDef) and node.name == name)


@cache
def tree_of(module: ModuleType) -> ast.Module:
    return ast.parse(inspect.getsource(module))


if __name__ == "__main__":
    LIST.write_text(listed(), encoding="utf-8")
