"""Reading examples: files of the wall-following data, and the same data from OpenML for who asks for it."""

import math
import re
import warnings

import numpy as np

from pathloom.errors import ConfigError
from pathloom.files import FilePath, lines, refusal, shown
from pathloom.local.actions import NAMES, Action
from pathloom.local.examples import Examples
from pathloom.local.sectors import WIDTHS
from pathloom.naming import closest, meant

OPENML = {24: (1,), 4: (3, 2), 2: (2, 3)}
"""Versions of the data set ``wall-robot-navigation`` on OpenML to look at, by the number of distances."""
COUNTS = {2205: Action.FORWARD, 826: Action.SLIGHT_RIGHT, 2097: Action.SHARP_RIGHT, 328: Action.SLIGHT_LEFT}
"""How often each action occurs in the data: no two as often, so that they tell which number stands for which."""

_NUMBERS = {name.lower(): number for number, name in enumerate(NAMES)} | {str(int(a)): int(a) for a in Action}


def read_examples(path: FilePath) -> Examples:
    """Return the examples in a file of comma-separated distances with the action last.

    As the wall-following data have it: 2, 4 or 24 distances in metres, the action by its name or its number; LF or
    CRLF, with or without an end of the last line. A first line without any number is taken for a heading and noted.

    Raises
    ------
    PathloomError
        If the file cannot be read, or a line is not like that; the message names the line.
    """
    rows = lines(path)
    notes: tuple[str, ...] = ()
    first = 0
    if len(rows) > 1 and not any(_is_number(field) for field in rows[0].split(",")):
        first, notes = 1, (f"{path}: line 1: a heading, left out",)
    width = len(rows[first].split(",")) - 1
    if width not in WIDTHS:
        found = f"{width + 1} columns"
        raise refusal(path, f"line {first + 1}", found, "2, 4 or 24 distances and an action, with commas between")
    distances = np.empty((len(rows) - first, width))
    actions = np.empty(len(rows) - first, np.int64)
    for number, row in enumerate(rows[first:], first + 1):
        *fields, label = row.split(",")
        where = f"line {number}"
        if len(fields) != width:
            raise refusal(path, where, f"{len(fields) + 1} columns", f"{width + 1} as in the first line")
        for column, field in enumerate(fields, 1):
            if not _is_number(field) or not 0.0 <= (value := float(field)) < math.inf:
                raise refusal(
                    path, f"{where}, column {column}", shown(field.strip()), "a distance in metres, from 0 on"
                )
            distances[number - first - 1, column - 1] = value
        action = _NUMBERS.get(label.strip().lower())
        if action is None:
            allowed = f"{', '.join(NAMES)} or 0 to {len(Action) - 1}"
            raise refusal(
                path, f"{where}, column {width + 1}", shown(label.strip()), allowed, meant(label.strip(), NAMES)
            )
        actions[number - first - 1] = action
    return Examples(distances, actions, str(path), notes)


def fetch_examples(name: str) -> Examples:
    """Fetch the wall-following data from OpenML: ``openml``, or ``openml:WIDTH`` with 2, 4 (default) or 24 distances.

    Raises
    ------
    ConfigError
        If there is no network, or what comes is not that data.
    """
    asked = re.fullmatch(r"openml(?::(\d+))?", name)
    width = int(asked[1] or 4) if asked else 0
    if width not in OPENML:
        raise ConfigError(f"{name}: found no such data; {closest(name, [f'openml:{w}' for w in OPENML])}")
    from sklearn.datasets import fetch_openml

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that it tries again; what comes of it is said below
            for version in OPENML[width]:
                fetched = fetch_openml("wall-robot-navigation", version=version, as_frame=False, parser="liac-arff")
                if fetched.data.shape[1] == width:
                    break
    except Exception as error:  # whatever a network, a proxy or a server comes up with
        cause = " ".join(str(error).split()) or type(error).__name__
        raise ConfigError(f"{name}: not fetched ({cause}); allowed with a network, or a file instead") from error
    labels, which, counts = np.unique(np.asarray(fetched.target).astype(str), return_inverse=True, return_counts=True)
    if sorted(counts.tolist()) != sorted(COUNTS) or fetched.data.shape[1] != width:
        found = f"{dict(zip(labels.tolist(), counts.tolist(), strict=True))} with {fetched.data.shape[1]} columns"
        raise ConfigError(f"{name}: fetched {found}, which are not the wall-following data")
    numbers = np.array([int(COUNTS[count]) for count in counts.tolist()])
    return Examples(np.asarray(fetched.data, np.float64), numbers[which], name)


def _is_number(field: str) -> bool:
    try:
        float(field)
    except ValueError:
        return False
    return True
