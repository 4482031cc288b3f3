"""Moving AI scenarios: start, goal and stated optimum of many problems on one map."""

import math
import re
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

from pathloom.files import FilePath, lines, neighbour, refusal, shown
from pathloom.grid.occupancy import OccupancyGrid

FIELDS = (
    "bucket",
    "map",
    "map width",
    "map height",
    "start x",
    "start y",
    "goal x",
    "goal y",
    "optimal length",
)

C_DIGITS = 6
"""Significant digits that C and C++ print where a program does not ask for more."""

ROOT_TWO_DRIFT = 2e-8
"""Relative error of stated lengths beyond their print: many were added up with the square
root of 2 in single precision (1.41421354) or cut after nine decimals (1.414213562)."""


@dataclass(frozen=True, slots=True)
class Case:
    """One line of a scenario.

    Lengths are those of 8-connected paths, in cells, a diagonal step only where both side
    cells are free. A stated optimum of 0 between different cells marks an unreachable
    goal in some files.
    """

    bucket: int
    map_name: str
    """As stated: often a path that exists on no computer of today."""
    height: int
    width: int
    start: tuple[int, int]
    """(row, col)."""
    goal: tuple[int, int]
    """(row, col)."""
    optimum: float
    tolerance: float
    """How far a correct length may lie from `optimum`: half a unit of its last printed
    place and what the programs that made the files lost in adding up."""


@dataclass(frozen=True, slots=True)
class Scenario:
    """The cases of a scenario file, in its order, from 0."""

    path: Path
    cases: tuple[Case, ...]

    def case(self, index: int) -> Case:
        """Return one case.

        Raises
        ------
        MapError
            If there is none of that number.
        """
        if not 0 <= index < len(self.cases):
            raise refusal(self.path, "", f"case {index}", f"0 to {len(self.cases) - 1}")
        return self.cases[index]

    def map_path(self, case: Case) -> Path:
        """Return the file of a case's map: of the stated path the last part, beside the scenario.

        Raises
        ------
        MapError
            If there is no such file.
        """
        beside = self.path.parent / re.split(r"[/\\]", case.map_name)[-1]
        try:
            found = beside.is_file()
        except (OSError, ValueError):  # too long a name, or a zero byte in it
            found = False
        if not found:
            raise refusal(
                self.path,
                f"map {shown(case.map_name)}",
                f"no file {shown(beside.name)} beside the scenario",
                "a map in the scenario's folder",
                neighbour(beside, ".map"),
            )
        return beside

    def check(self, case: Case, grid: OccupancyGrid) -> None:
        """Make sure that a map has the size that a case states.

        Raises
        ------
        MapError
            If it has not.
        """
        if grid.shape != (case.height, case.width):
            found = f"a map {grid.name} of {grid.height} x {grid.width} cells (height x width)"
            raise refusal(self.path, "", found, f"{case.height} x {case.width}, as the scenario states")


def read_scenario(path: FilePath) -> Scenario:
    """Return the cases of a `.scen` file of version 1, fields apart by tabs or by blanks.

    Raises
    ------
    MapError
        If the file cannot be read, or a line is malformed; says which one, and why.
    """
    text = lines(path)
    if not re.fullmatch(r"version\s+1(\.0)?\s*", text[0]):
        raise refusal(path, "line 1", shown(text[0]), "'version 1'")
    rows = [(number, _fields(path, number, line)) for number, line in enumerate(text[1:], start=2) if line.strip()]
    if not rows:
        raise refusal(path, "line 2", "the end of the file", "one case or more")
    half_units = _half_units([fields[-1] for _, fields in rows])
    cases = (
        _case(path, number, fields, half_unit) for (number, fields), half_unit in zip(rows, half_units, strict=True)
    )
    return Scenario(Path(path), tuple(cases))


def _fields(path: FilePath, number: int, line: str) -> list[str]:
    """Return the nine fields of a line, the last one known to be a plain number."""
    fields = line.strip().split("\t") if "\t" in line else line.split()
    if len(fields) != len(FIELDS):
        raise refusal(path, f"line {number}", f"{len(fields)} fields", f"9: {', '.join(FIELDS)}")
    if not re.fullmatch(r"[0-9]{1,20}(\.[0-9]{0,20})?([eE][+-]?[0-9]{1,2})?", fields[-1]):
        raise refusal(path, f"line {number}, optimal length", shown(fields[-1]), "a number from 0")
    return fields


def _case(path: FilePath, number: int, fields: list[str], half_unit: float) -> Case:
    whole = {}
    for name, word in zip(FIELDS, fields, strict=True):
        if name in {"map", "optimal length"}:
            continue
        if not re.fullmatch("[0-9]{1,9}", word):
            raise refusal(path, f"line {number}, {name}", shown(word), "a whole number from 0")
        whole[name] = int(word)
    for name, size in (("x", "map width"), ("y", "map height")):
        for end in ("start", "goal"):
            value = whole[f"{end} {name}"]
            if value >= whole[size]:
                allowed = f"less than the {size} {whole[size]}"
                raise refusal(path, f"line {number}, {end} {name}", str(value), allowed)
    optimum = float(fields[-1])
    return Case(
        bucket=whole["bucket"],
        map_name=fields[1],
        height=whole["map height"],
        width=whole["map width"],
        start=(whole["start y"], whole["start x"]),
        goal=(whole["goal y"], whole["goal x"]),
        optimum=optimum,
        tolerance=half_unit + ROOT_TWO_DRIFT * optimum,
    )


def _half_units(words: list[str]) -> list[float]:
    """Return half a unit in the last place of each length of a file.

    A file that gives all lengths with the same number of decimals has them fixed.
    Otherwise they were printed with six significant digits and their last zeros left
    out: there `5` stands for 5.00000, and is no less precise than `2.41421`.
    """
    numbers = [Decimal(word) for word in words]
    exponents = {int(number.as_tuple().exponent) for number in numbers}
    if len(exponents) == 1 and max(exponents) < 0:
        return [0.5 * math.pow(10.0, max(exponents))] * len(numbers)
    digits = max(C_DIGITS, *(len(number.as_tuple().digits) for number in numbers))
    places = [number.adjusted() if number else 0 for number in numbers]
    return [0.5 * math.pow(10.0, place + 1 - digits) for place in places]
