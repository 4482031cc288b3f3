"""What runs are measured by: its name in a row, how people call it, and which way is better."""

from dataclasses import dataclass
from typing import Literal

from pathloom.errors import ConfigError
from pathloom.naming import closest


@dataclass(frozen=True)
class Metric:
    """One measure of a run."""

    name: str
    """The field of a row; ``success`` is made of the status."""
    label: str
    better: Literal["less", "more"] = "less"
    unit: str = ""
    """Written after a value; ``%`` for shares, which are then shown times 100."""
    digits: int = 2
    yes_or_no: bool = False
    """Each run has it or has not; what is compared is the share of the runs, and a run that has it costs −1, else 0."""
    target: bool = False
    """Counts evaluations up to a target: a run that found a path and has no value missed the target."""

    @property
    def sign(self) -> float:
        """Factor that makes a cost of a value: less is better."""
        return 1.0 if self.better == "less" else -1.0

    short: str = ""
    """For headings of tables."""

    @property
    def head(self) -> str:
        """Heading of a column, with the unit."""
        return f"{self.short or self.label}{f' ({self.unit})' if self.unit else ''}"

    @property
    def apart(self) -> str:
        """Unit of a difference."""
        return "percentage points" if self.unit == "%" else self.unit

    def number(self, value: float | None, *, signed: bool = False) -> str:
        """Return a value without its unit; a dash for none."""
        if value is None:
            return "–"
        scale = 100.0 if self.unit == "%" else 1.0
        digits = 0 if self.target else self.digits
        return f"{round(value * scale, digits) + 0.0:{'+' if signed else ''}.{digits}f}".replace("-", "−")

    def show(self, value: float | None) -> str:
        """Return a value with its unit."""
        return f"{self.number(value)} {self.unit}" if self.unit and value is not None else self.number(value)

    def show_difference(self, value: float, low: float | None = None, high: float | None = None) -> str:
        """Return a difference with its interval and unit."""
        text = self.number(value, signed=True)
        if low is not None or high is not None:
            text += f" [{self.number(low, signed=True)}, {self.number(high, signed=True)}]"
        return f"{text} {self.apart}" if self.apart else text


SUCCESS = Metric("success", "success rate", "more", "%", 1, yes_or_no=True, short="found")
METRICS = {
    metric.name: metric
    for metric in (
        SUCCESS,
        Metric("gap_any_angle", "gap to the any-angle optimum", unit="%", digits=2, short="any-angle gap"),
        Metric("gap_grid", "gap to the grid optimum", unit="%", digits=2, short="grid gap"),
        Metric("gap_bound", "gap to the lower bound", unit="%", digits=2, short="gap to bound"),
        Metric("length", "length", unit="cells", digits=2),
        Metric("fitness", "fitness", "more", digits=4),
        Metric("turns", "turns", digits=1),
        Metric("turn_angle", "turn angle", unit="rad"),
        Metric("min_clearance", "least clearance", "more", "cells", short="clearance"),
        Metric("unsafe_nodes", "unsafe nodes", digits=1),
        Metric("nodes", "nodes", digits=1),
        Metric("hypervolume", "hypervolume", "more", digits=4),
        Metric("hypervolume_ratio", "hypervolume ratio", "more", digits=4, short="HV ratio"),
        Metric("evaluations_to_first", "evaluations to the first path", target=True, short="evals to first"),
        Metric(
            "evaluations_to_one_percent", "evaluations to within 1 % of the optimum", target=True, short="evals to 1 %"
        ),
        Metric("evaluations", "evaluations", digits=0),
        Metric("generations", "generations", digits=0),
        Metric("seconds", "time", unit="s", digits=3),
    )
}
GAPS = ("gap_any_angle", "gap_grid", "gap_bound")
"""From the sharpest on; a summary takes the first that is known."""
USUAL = (
    "length", "fitness", "turns", "min_clearance", "hypervolume_ratio",
    "evaluations_to_first", "evaluations_to_one_percent",
)  # fmt: skip
"""What a summary shows beside success rate and gap, where it is known."""


def metric(name: str) -> Metric:
    """Return the metric of a name.

    Raises
    ------
    ConfigError
        If there is none.
    """
    if name not in METRICS:
        raise ConfigError(f"metric: none is called {name!r}; {closest(name, METRICS)}")
    return METRICS[name]
