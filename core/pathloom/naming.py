"""What somebody probably meant."""

import difflib
from collections.abc import Iterable


def a(word: str) -> str:
    """Return a word with its indefinite article."""
    return f"{'an' if word[:1] in 'aeiou' else 'a'} {word}"


def meant(word: str, known: Iterable[str]) -> str:
    """Return a hint to the known name most like a misspelt one; empty when nothing is near."""
    names = sorted(set(known))
    near = difflib.get_close_matches(word, names, n=1)
    if not near:
        # `imga/median-insertion` is meant by `median-insertion`, whatever stands before it.
        tails = {name.rpartition("/")[2]: name for name in names}
        near = [tails[t] for t in difflib.get_close_matches(word.rpartition("/")[2], tails, n=1, cutoff=0.7)]
    return f"did you mean {near[0]!r}?" if near else ""


def closest(word: str, known: Iterable[str]) -> str:
    """Return a hint for a misspelt name, or the list of names when nothing is near."""
    names = sorted(set(known))
    return meant(word, names) or f"known: {', '.join(names) or 'none'}"
