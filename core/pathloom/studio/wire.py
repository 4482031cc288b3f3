"""What page and server say to each other over the socket, one JSON object a message.

Everything that comes in is checked against these types before anything else sees it.
"""

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct, json

from pathloom.paths.context import Corners

LONGEST_SIDE = 1024
"""Cells along a side of a map on the page."""
WINDOW = 64
"""Generations that may be asked for ahead."""

Number = float | None
"""JSON has no infinity: it becomes null."""
Side = Annotated[int, Meta(ge=1, le=LONGEST_SIDE)]
Cell = tuple[int, int]
Ids = list[int]
"""A path as flat cell ids, row * cols + col."""


class Drawn(Struct, frozen=True, forbid_unknown_fields=True):
    """A map as it is on the page: one bit a cell, row by row from the top, 1 for an obstacle; base64 in JSON."""

    rows: Side
    cols: Side
    bits: bytes


class Scene(Struct, frozen=True, forbid_unknown_fields=True):
    """A path problem as it is on the page."""

    map: Drawn
    start: Cell
    goal: Cell
    corners: Corners = "strict"
    radius: Annotated[float, Meta(ge=0, le=LONGEST_SIDE)] = 0.0
    """In cells."""
    name: str = ""
    """What the map was called before somebody drew on it."""


class Asked(Struct, frozen=True, forbid_unknown_fields=True):
    """A run: what ``pathloom plan`` would be asked for."""

    scene: Scene
    planner: dict[str, Any]
    """A table with ``use``, as in a config."""
    seed: Annotated[int, Meta(ge=0, le=2**53)] = 0


Lane = Literal[0, 1]
"""Which of the two planners side by side."""


class Begin(Struct, frozen=True, forbid_unknown_fields=True, tag="begin"):
    """Begin a run in a lane, in place of the one before."""

    lane: Lane
    run: int
    """The page's number for it; answers bear it."""
    asked: Asked


class More(Struct, frozen=True, forbid_unknown_fields=True, tag="more"):
    """Let a run go on for so many generations: nothing moves that nobody asked for."""

    lane: Lane
    run: int
    generations: Annotated[int, Meta(ge=1, le=WINDOW)] = 1


class Stop(Struct, frozen=True, forbid_unknown_fields=True, tag="stop"):
    """Forget the run of a lane."""

    lane: Lane


Heard = Begin | More | Stop


class Begun(Struct, frozen=True, tag="begun"):
    """A run stands at its beginning."""

    lane: int
    run: int
    planner: str
    objectives: list[str]
    generations: int | None
    """After how many it ends at the latest, where a limit says so."""


class Compiling(Struct, frozen=True, tag="compiling"):
    """Kernels are compiled, once on a machine; so many of so many are done."""

    lane: int
    run: int
    done: int
    all: int


class Front(Struct, frozen=True):
    """Trade-offs, with the path of each."""

    values: list[list[Number]]
    paths: list[Ids]
    knee: int | None = None


class Generation(Struct, frozen=True, tag="generation"):
    """One generation, as it is drawn."""

    lane: int
    run: int
    generation: int
    evaluations: int
    best: Ids
    """The best path so far; empty where there is none."""
    length: Number
    """Its length in cells."""
    values: dict[str, Number]
    """Its objectives by label."""
    fitness: Number
    """The best so far."""
    mean: Number
    diversity: Number
    paths: list[Ids]
    """Distinct individuals, the fittest last; of very many a part."""
    individuals: int
    rates: dict[str, tuple[Number, Number, Number]]
    """Least, mean and greatest probability of crossover and mutation over the population."""
    front: Front | None = None


class Ended(Struct, frozen=True, tag="ended"):
    """The run is over: its answer, verified."""

    lane: int
    run: int
    path: Ids
    curve: list[tuple[float, float]]
    """The smooth way along the path, (row, column), where the planner makes one."""
    result: dict[str, Any]
    """The document of ``pathloom plan``."""
    front: Front | None = None


class Refused(Struct, frozen=True, tag="refused"):
    """What cannot be done and why, in one line, and which part of the page it belongs to."""

    where: str
    """``start``, ``goal``, ``map``, ``planner``, ``seed``, or empty."""
    message: str
    lane: int | None = None
    run: int | None = None


Said = Begun | Compiling | Generation | Ended | Refused


class Look(Struct, frozen=True):
    """What a glance at a scene tells, before any run."""

    fault: Refused | None
    closed: bytes | None
    """Cells closed by the robot's radius, as in `Drawn`; ``None`` without a radius."""


class Files(Struct, frozen=True, forbid_unknown_fields=True):
    """Files of a map: one, or the ``.yaml`` of a ROS map with its image; base64 in JSON."""

    files: Annotated[dict[str, bytes], Meta(min_length=1, max_length=4)]


class Named(Struct, frozen=True, forbid_unknown_fields=True):
    """A map by its name."""

    name: Annotated[str, Meta(max_length=200)]
    corners: Corners = "strict"


class Map(Struct, frozen=True):
    """A map for the page."""

    map: Drawn
    name: str
    note: str = ""
    """What the page has to know of it."""


class Saved(Struct, frozen=True):
    """A config file, and where it does not do with a name, the map beside it."""

    toml: str
    map_file: str | None = None
    map: str | None = None


_heard: json.Decoder[Heard] = json.Decoder(Heard)
encode = json.Encoder().encode


def heard(text: str) -> Heard:
    """Return the message that a text of JSON is.

    Raises
    ------
    msgspec.MsgspecError, RecursionError
        If it is none of them.
    """
    return _heard.decode(text)
