"""How the fitness of a run converged, and how diverse its populations were."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pathloom.draw.colours import Theme
from pathloom.draw.look import STEPS, TEXT, Floats, dress

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Curves:
    """What the history says, generation by generation."""

    evaluations: Floats
    counted: bool
    """Whether the first axis counts evaluations; otherwise it counts generations."""
    fitness: Mapping[str, Floats]
    diversity: Floats | None

    @classmethod
    def read(cls, history: Mapping[str, Any]) -> "Curves | None":
        """Return the curves of a history, or ``None`` where there is nothing to draw."""
        lists = {k: _numbers(history.get(k)) for k in ("evaluations", "best", "generation_best", "mean", "diversity")}
        known = {k: v for k, v in lists.items() if v is not None and len(v)}
        fitness = [k for k in ("best", "generation_best", "mean") if k in known and np.isfinite(known[k]).any()]
        n = min((len(v) for v in known.values()), default=0)
        if n < 2 or not fitness:
            return None
        counted = "evaluations" in known
        x = known["evaluations"][:n] if counted else np.arange(n, dtype=np.float64)
        spread = known.get("diversity")
        shown = spread is not None and np.isfinite(spread[:n]).any()
        return cls(
            x,
            counted,
            {k: known[k][:n] for k in fitness},
            spread[:n] if spread is not None and shown else None,
        )

    def draw(self, panels: "Sequence[Axes]", colours: Theme) -> None:
        """Draw fitness on the first panel and diversity on the second, if there is one."""
        from matplotlib.ticker import EngFormatter, FuncFormatter, MaxNLocator

        looks: dict[str, tuple[str, dict[str, Any]]] = {
            "mean": ("mean", {"color": colours.mean, "linewidth": 1.2, "linestyle": (0, (4, 1.5))}),
            "generation_best": ("of generation", {"color": colours.optimum, "linewidth": 1.2}),
            "best": ("best so far", {"color": colours.path, "linewidth": 2.0, "drawstyle": "steps-post"}),
        }
        top, bottom = panels[0], panels[-1]
        for name, (label, look) in looks.items():
            if name in self.fitness:
                top.plot(self.evaluations, self.fitness[name], label=label, **look)
        values = np.concatenate(list(self.fitness.values()))
        values = values[np.isfinite(values)]
        if values.min() > 0 and values.max() > 300 * values.min():
            top.set_yscale("log")
        else:
            top.yaxis.set_major_locator(MaxNLocator(nbins=5, steps=[1, 2, 2.5, 5, 10]))
            top.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        top.set_ylabel("fitness", size=TEXT)
        if self.diversity is not None:
            bottom.plot(self.evaluations, self.diversity, color=colours.start, linewidth=1.3)
            bottom.set_ylim(bottom=min(0.0, float(np.nanmin(self.diversity))))
            bottom.set_ylabel("diversity", size=TEXT)
            bottom.yaxis.set_major_locator(MaxNLocator(nbins=2, steps=STEPS))
            bottom.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            top.tick_params(labelbottom=False)
        for axes in panels:
            dress(axes, colours)
            axes.margins(x=0.02)
            axes.grid(visible=True, color=colours.faint, linewidth=0.6)
            axes.set_axisbelow(True)
            axes.spines[["top", "right"]].set_visible(False)
        bottom.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True, steps=STEPS))
        bottom.xaxis.set_major_formatter(EngFormatter(sep=""))
        bottom.set_xlabel("evaluations" if self.counted else "generation", size=TEXT)


def _numbers(values: Any) -> Floats | None:
    """Return a list of numbers as floats; what is missing in it, or infinite, becomes nan."""
    if values is None:
        return None
    numbers = np.array([np.nan if v is None else v for v in values], np.float64)
    numbers[~np.isfinite(numbers)] = np.nan
    return numbers
