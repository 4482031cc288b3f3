"""Meaning: what a component's class says of its parameters."""

import ast
import inspect
import linecache
from collections.abc import Iterator
from functools import cache
from itertools import pairwise


def meanings_of(component: type) -> dict[str, str]:
    """Return the docstrings that stand below the fields of a class and its bases, by field."""
    meanings: dict[str, str] = {}
    for base in reversed(component.__mro__):
        try:
            file = inspect.getsourcefile(base)
        except (OSError, TypeError):  # built in, or typed in
            continue
        meanings |= _in_file(file).get(base.__qualname__, {}) if file else {}
    return meanings


@cache
def _in_file(file: str) -> dict[str, dict[str, str]]:
    """Return the meanings of fields in all classes of a file, by the classes' qualified names."""
    try:
        tree = ast.parse("".join(linecache.getlines(file)))
    except SyntaxError:
        return {}
    return {name: dict(_fields(found)) for name, found in _classes(tree, "")}


def _classes(tree: ast.AST, within: str) -> Iterator[tuple[str, ast.ClassDef]]:
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.ClassDef):
            yield within + node.name, node
            yield from _classes(node, f"{within}{node.name}.")
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield from _classes(node, f"{within}{node.name}.<locals>.")
        else:
            yield from _classes(node, within)


def _fields(found: ast.ClassDef) -> Iterator[tuple[str, str]]:
    for statement, text in pairwise(found.body):
        if (
            isinstance(statement, ast.AnnAssign)
            and isinstance(statement.target, ast.Name)
            and isinstance(text, ast.Expr)
            and isinstance(text.value, ast.Constant)
        ):
            yield statement.target.id, " ".join(str(text.value.value).split())
