"""Meaning: what a component's class says of its parameters."""

import ast
import inspect
import textwrap
from itertools import pairwise


def meanings_of(component: type) -> dict[str, str]:
    """Return the docstrings that stand below the fields of a class and its bases, by field."""
    meanings: dict[str, str] = {}
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
                meanings[statement.target.id] = " ".join(str(text.value.value).split())
    return meanings
