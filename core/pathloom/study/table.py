"""Tables of a study for notebooks."""

from collections.abc import Iterable, Sequence
from html import escape


def html(heads: Sequence[str], rows: Iterable[Sequence[str]], caption: str) -> str:
    """Return a table as HTML; the first column holds names, the others numbers."""
    head = "".join(f"<th>{escape(text)}</th>" for text in heads)
    body = "".join(
        f"<tr><th>{escape(first)}</th>{''.join(f'<td>{escape(text)}</td>' for text in rest)}</tr>"
        for first, *rest in rows
    )
    return f"<table><caption>{escape(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
