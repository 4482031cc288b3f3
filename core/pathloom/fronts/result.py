"""ParetoResult: a front, what it took to find it, and how good it is; to and from JSON."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from pathloom.fronts.against import Placement, Rival
from pathloom.kernel.evaluation import Floats
from pathloom.paths.cell_paths import Path
from pathloom.paths.problem import PathProblem
from pathloom.result import Document, Status, map_title, plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Member(NamedTuple):
    """One trade-off."""

    path: Path
    """(k, 2), cells from start to goal."""
    values: Floats
    """(m,), one for each objective."""
    pseudo_weights: Floats
    """(m,), how much each objective counts for whoever takes this one; they sum to 1."""


@dataclass(frozen=True)
class Choice:
    """Which members of a front suggest themselves, by their place on it."""

    knee: int
    """Where giving up a little of one objective gains most of the others."""
    preferred: int | None = None
    """The one that fits the preference best; ``None`` where there is no preference."""
    preference: Mapping[str, float] = field(default_factory=dict)
    """The wanted weights by objective; they sum to 1."""


@dataclass(frozen=True)
class ParetoResult(Document):
    """The outcome of planning a front. Cells are (row, column), all objectives are minimised."""

    schema: ClassVar[str] = "pathloom.pareto/1"

    status: Status
    planner: str
    """Name of the planner."""
    seed: int
    problem: Mapping[str, Any]
    """Map, its hash and size, start, goal, corner policy and radius."""
    objectives: tuple[str, ...]
    """Labels of the objectives, in the order of the values."""
    values: Floats = field(default_factory=lambda: np.empty((0, 0)))
    """(n, m), in lexicographic order; no row dominates another."""
    paths: tuple[Path, ...] = ()
    """n paths, each (k, 2), from start to goal."""
    pseudo_weights: Floats = field(default_factory=lambda: np.empty((0, 0)))
    """(n, m), what each member is good at; rows sum to 1."""
    world: tuple[Floats, ...] | None = None
    """n paths (k, 2), x and y in metres, where the map has a place in the world."""
    choice: Choice | None = None
    """Knee and preferred member; ``None`` without a front."""
    indicators: Mapping[str, Any] = field(default_factory=dict)
    """Hypervolume with its reference point, ideal, nadir; with the exact front also what is measured against it."""
    exact: Floats | None = None
    """(k, m), values of the exact front, where it was asked for and could be had."""
    against: tuple[Rival, ...] = ()
    """Where other planners' paths lie beside the front."""
    budget: Mapping[str, Any] = field(default_factory=dict)
    """Generations, evaluations, seconds, seconds by phase, and what operators counted."""
    history: Mapping[str, Any] = field(default_factory=dict)
    """What each generation was like."""
    config: Mapping[str, Any] = field(default_factory=dict)
    """The complete config that repeats the run."""
    versions: Mapping[str, str] = field(default_factory=dict)
    reason: str = ""
    """Why there is no front, or what is missing of what was asked for."""
    interrupted: bool = False

    path_problem: PathProblem | None = field(default=None, repr=False, compare=False)
    """The problem itself; not in the JSON."""

    def __len__(self) -> int:
        """Return the number of trade-offs."""
        return len(self.values)

    @property
    def found(self) -> bool:
        """Whether there is a front."""
        return self.status == "found"

    @property
    def front(self) -> list[Member]:
        """The members, each with its path, its values and its pseudo-weights."""
        return [Member(*member) for member in zip(self.paths, self.values, self.pseudo_weights, strict=True)]

    @property
    def map_title(self) -> str:
        """Name of the map without its folder."""
        return map_title(self.problem)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document as Python values."""
        members = [plain(member._asdict()) for member in self.front]
        for member, place in zip(members, self.world or (), strict=False):
            member["world"] = plain(place)
        document: dict[str, Any] = {"schema": self.schema}
        for item in fields(self):
            if item.name == "values":
                document["front"] = members
            elif item.name not in ("paths", "pseudo_weights", "world", "path_problem"):
                document[item.name] = _written(getattr(self, item.name))
        return document

    @classmethod
    def read(cls, values: dict[str, Any]) -> dict[str, Any]:
        members, m = values.pop("front"), len(values["objectives"])
        values["objectives"] = tuple(values["objectives"])
        values["values"] = np.array([member["values"] for member in members], np.float64).reshape(-1, m)
        values["paths"] = tuple(np.array(member["path"], np.int64).reshape(-1, 2) for member in members)
        weights = [member["pseudo_weights"] for member in members]
        values["pseudo_weights"] = np.array(weights, np.float64).reshape(-1, m)
        if members and "world" in members[0]:
            values["world"] = tuple(np.array(member["world"], np.float64).reshape(-1, 2) for member in members)
        if values.get("choice") is not None:
            values["choice"] = Choice(**values["choice"])
        if values.get("exact") is not None:
            values["exact"] = np.array(values["exact"], np.float64).reshape(-1, m)
        values["against"] = tuple(_rival(rival) for rival in values.get("against", ()))
        return values

    def plot(self, file: Any = None, *, panels: Any = None, colour: str | None = None, dark: bool = False) -> "Figure":
        """Draw the front; save to ``file`` if one is given.

        Parameters
        ----------
        file
            ``.png``, ``.svg`` or ``.pdf``.
        panels
            Some of ``paths`` (the map with the front's paths), ``scatter`` (for three
            objectives and more a matrix of scatters) and ``parallel`` (coordinates);
            by default all of them, the last from three objectives on.
        colour
            The objective by which paths are coloured; by default the first one.
        dark
            For dark ground.

        Raises
        ------
        PathloomError
            If there is no front, no such objective, or the result was read from
            JSON, which does not hold the map, and paths are to be drawn.
        """
        from pathloom.draw import save
        from pathloom.fronts.drawing import figure_of

        figure = figure_of(self, panels, colour, dark=dark)
        if file is not None:
            save(figure, file)
        return figure

    def _repr_svg_(self) -> str | None:
        """Return the figure, for notebooks; a front that is empty or was read from JSON has none."""
        if not self.found or self.path_problem is None:
            return None
        from pathloom.draw.saving import svg

        return svg(self.plot())


def _written(value: Any) -> Any:
    """Return JSON values only."""
    if isinstance(value, (Choice, Rival, Placement)):
        return {name: _written(part) for name, part in vars(value).items()}
    if isinstance(value, tuple):
        return [_written(part) for part in value]
    return plain(value)


def _rival(table: Mapping[str, Any]) -> Rival:
    placements = []
    for placement in table["placements"]:
        read: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in placement.items()}
        placements.append(Placement(**read))
    return Rival(**{**table, "placements": tuple(placements)})
