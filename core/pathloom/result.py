"""Result: what a run found, what it took, and how good it is; to and from JSON."""

import json
import math
import platform
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import cache, cached_property
from importlib.metadata import version
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self

import numpy as np
from numpy.typing import NDArray

from pathloom.errors import PathloomError
from pathloom.paths.curves import Curve
from pathloom.paths.problem import PathProblem

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Status = Literal["found", "unreachable", "not-found"]


class Document(ABC):
    """A result that can be written as a JSON document and read again."""

    schema: ClassVar[str]
    """Name and version of the document's form."""

    @abstractmethod
    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document as Python values."""

    def to_json(self) -> str:
        """Return the result as a JSON document."""
        return json.dumps(self.to_dict(), allow_nan=False, ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> Self:
        """Return the result that a JSON document describes; it knows the map by name only.

        Raises
        ------
        PathloomError
            If it is no document of this kind.
        """
        try:
            document = json.loads(text)
            if document.pop("schema") != cls.schema:
                raise KeyError("schema")
            values = cls.read(document)
            known = {f.name for f in fields(cls)} - {"path_problem"}  # type: ignore[arg-type]  # all are dataclasses
            return cls(**{k: v for k, v in values.items() if k in known})
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise PathloomError(f"no document of schema {cls.schema!r}: {type(error).__name__}: {error}") from error

    @classmethod
    @abstractmethod
    def read(cls, values: dict[str, Any]) -> dict[str, Any]:
        """Return the values of the fields that those of a document stand for."""


@dataclass(frozen=True)
class Result(Document):
    """The outcome of planning one path. Cells are (row, column), lengths are in cells."""

    schema: ClassVar[str] = "pathloom.plan/1"

    status: Status
    planner: str
    """Name of the planner."""
    seed: int
    problem: Mapping[str, Any]
    """Map, its hash and size, start, goal, corner policy and radius."""
    path: NDArray[np.int64] | None = None
    """(k, 2), cells from start to goal; ``None`` where none was found."""
    unrefined: NDArray[np.int64] | None = None
    """(k, 2), the path before the planner's refinement, which was checked as well."""
    world: NDArray[np.float64] | None = None
    """(k, 2), x and y in metres, where the map has a place in the world."""
    curve: Curve | None = None
    """A smooth way along the path, where one was asked for or the planner makes one."""
    metrics: Mapping[str, Any] = field(default_factory=dict)
    objectives: Mapping[str, float] = field(default_factory=dict)
    """Values of the planner's objectives, by label."""
    fitness: float | None = None
    optimum: Mapping[str, float | None] | None = None
    """``grid``, the octile optimum, ``any_angle``, ``None`` where it was out of reach, and ``any_angle_bound``.

    No path is shorter than the last, which is the any-angle optimum itself where that is known.
    """
    gap: Mapping[str, float | None] | None = None
    """length / optimum − 1."""
    budget: Mapping[str, Any] = field(default_factory=dict)
    """Generations, evaluations, seconds, seconds by phase, and what operators counted."""
    history: Mapping[str, Any] = field(default_factory=dict)
    """For each generation: evaluations so far, best fitness so far, the generation's own, mean, diversity."""
    config: Mapping[str, Any] = field(default_factory=dict)
    """The complete config that repeats the run."""
    versions: Mapping[str, str] = field(default_factory=dict)
    reason: str = ""
    """Why there is no path."""
    interrupted: bool = False

    path_problem: PathProblem | None = field(default=None, repr=False, compare=False)
    """The problem itself; not in the JSON."""

    @property
    def found(self) -> bool:
        """Whether there is a path."""
        return self.status == "found"

    @cached_property
    def length(self) -> float:
        """Length in cells; inf without a path."""
        return float(self.metrics.get("length", math.inf))

    @property
    def convergence(self) -> int | None:
        """The generation that found the best fitness of the run; ``None`` without a history."""
        best = self.history.get("best") or []
        return next((k for k, value in enumerate(best) if value == best[-1]), None)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document as Python values."""
        known = {item.name: plain(getattr(self, item.name)) for item in fields(self) if item.name != "path_problem"}
        return {"schema": self.schema, **known}

    @classmethod
    def read(cls, values: dict[str, Any]) -> dict[str, Any]:
        for name, dtype in (("path", np.int64), ("unrefined", np.int64), ("world", np.float64)):
            if values.get(name) is not None:
                values[name] = np.array(values[name], dtype).reshape(-1, 2)
        if values.get("curve") is not None:
            values["curve"] = _curve(values["curve"])
        return values

    def plot(self, file: Any = None, *, dark: bool = False) -> "Figure":
        """Draw map, path and convergence; save to ``file`` if one is given.

        Raises
        ------
        PathloomError
            If the result was read from JSON, which does not hold the map.
        """
        if self.path_problem is None:
            raise PathloomError("this result does not hold its map: it was read from JSON")
        from pathloom.draw import path_figure, save

        problem, it = self.path_problem, self.path_problem.context
        start, goal = problem.ends
        figure = path_figure(
            problem.grid.occupied,
            closed=it.occupied if problem.radius else None,
            start=start,
            goal=goal,
            path=self.path,
            unrefined=self.unrefined if self._was_refined() else None,
            curve=self.curve.points if self.curve is not None else None,
            history=self.history,
            title=f"{self.planner} on {map_title(self.problem)}",
            caption=self._caption(),
            resolution=problem.grid.resolution if problem.grid.metric else None,
            dark=dark,
        )
        if file is not None:
            save(figure, file)
        return figure

    def _repr_svg_(self) -> str | None:
        """Return the figure, for notebooks; a result that was read from JSON has none."""
        if self.path_problem is None:
            return None
        from pathloom.draw.saving import svg

        return svg(self.plot())

    def _was_refined(self) -> bool:
        return self.path is not None and self.unrefined is not None and not np.array_equal(self.path, self.unrefined)

    def _caption(self) -> str:
        if not self.found:
            return self.reason
        turns = self.metrics["turns"]
        parts = [f"length {self.length:.4f}", f"{turns} turn{'s' * (turns != 1)}", f"seed {self.seed}"]
        if self.curve is not None:
            parts.insert(1, f"curve {self.curve.length:.4f}")
        gaps = self.gap or {}
        if (gap := gaps.get("any_angle")) is not None:
            parts.append(f"{100 * gap:.2f} % above the any-angle optimum")
        elif (gap := gaps.get("any_angle_bound")) is not None:
            parts.append(f"at most {100 * gap:.2f} % above the any-angle optimum")
        return ", ".join(parts)


def map_title(described: Mapping[str, Any]) -> str:
    """Return the name of a described problem's map without its folder."""
    name = str(described["map"]).replace("\\", "/").rpartition("/")[2]
    return name.encode("utf-8", "replace").decode()  # a file's name need not be text


def describe_problem(problem: PathProblem, name: str) -> dict[str, Any]:
    """Return what a document says of a problem."""
    grid = problem.grid
    start, goal = problem.ends
    return {
        "map": name,
        "map_sha256": grid.sha256,
        "height": grid.height,
        "width": grid.width,
        "resolution": grid.resolution,
        "start": list(start),
        "goal": list(goal),
        "corners": problem.corners,
        "radius": problem.radius,
    }


@cache
def versions() -> Mapping[str, str]:
    """Return the versions on which a result may depend."""
    named = {name: version(name) for name in ("pathloom", "numpy", "numba")}
    return {"pathloom": named.pop("pathloom"), "python": platform.python_version(), **named}


def _curve(table: Mapping[str, Any]) -> Curve:
    """Return the curve of a document, where a curvature without bound is null."""
    curvature = table["max_curvature"]
    points = np.array(table["points"], np.float64).reshape(-1, 2)
    return Curve(**{**table, "points": points, "max_curvature": math.inf if curvature is None else curvature})


def plain(value: Any) -> Any:
    """Return JSON values only; what JSON cannot say (infinity) becomes null."""
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, Curve):
        return plain(vars(value))
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    return value
