"""Design: what runs in a study. Variants, instances, and how often.

An ablation takes a base and changes one thing at a time; a comparison takes
planners as they are. Every variant meets the same instances with the same
seeds, so that runs are paired, and may spend the same budget.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any

from pathloom.errors import ConfigError
from pathloom.kernel.component import Component, parameters
from pathloom.kernel.compose import NONE, compose, freeze, override
from pathloom.kernel.front import FrontPlanner
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import default_registry
from pathloom.study.budget import Budget
from pathloom.study.instances import Instance

MOST_VARIANTS = 4096
"""Variants beyond which a full factorial is refused."""


@dataclass(frozen=True)
class Variant:
    """One method of a study. Nobody watches its runs, which may be many at a time: the study keeps what they did."""

    name: str
    planner: Planner
    changes: Mapping[str, str] = field(default_factory=dict)
    """What it has in place of the base's own, by slot; ``none`` where it goes without."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "planner", self.planner.unwatched)


@dataclass(frozen=True)
class Design:
    """What runs: every variant on every instance with every seed."""

    kind: str
    """``ablate``, ``compare`` or what else made it."""
    variants: tuple[Variant, ...]
    instances: tuple[Instance, ...]
    runs: int = 30
    """Runs of each variant on each instance."""
    seed: int = 0
    """The first seed; the others follow."""
    budget: Budget = field(default_factory=Budget)
    time_limit: float | None = None
    """Seconds after which a run has to answer with the best it has; it is ended if it does not."""
    notes: tuple[str, ...] = ()
    """What a reader of the study should know."""

    def __post_init__(self) -> None:
        if isinstance(self.runs, bool) or not isinstance(self.runs, int) or self.runs < 1:
            raise ConfigError(f"runs: found {self.runs!r}, allowed a whole number from 1")
        if isinstance(self.seed, bool) or not isinstance(self.seed, int) or self.seed < 0:
            raise ConfigError(f"seed: found {self.seed!r}, allowed an integer from 0")
        if self.time_limit is not None and not self.time_limit > 0:
            raise ConfigError(f"time limit: found {self.time_limit!r}, allowed seconds above 0")
        if not self.instances:
            raise ConfigError("maps: found none, allowed one or more")
        _refuse_alike(self.variants)
        fronts = [v for v in self.variants if isinstance(v.planner, FrontPlanner)]
        if fronts and len(fronts) < len(self.variants):
            single = next(v.name for v in self.variants if v not in fronts)
            raise ConfigError(
                f"{single!r} answers with one path, {fronts[0].name!r} with a front: compare like with like"
            )
        if len({tuple(v.planner.terms.objectives()) for v in fronts}) > 1:
            raise ConfigError("fronts of different objectives cannot be compared; give all planners the same")

    @property
    def size(self) -> int:
        """The number of runs."""
        return len(self.variants) * len(self.instances) * self.runs

    @property
    def front(self) -> bool:
        """Whether the answers are fronts."""
        return isinstance(self.variants[0].planner, FrontPlanner)


def ablation(
    base: str | Mapping[str, Any] | Planner,
    *,
    swap: Mapping[str, Sequence[Any]] | None = None,
    without: Sequence[str] = (),
    factorial: bool = False,
    add_one_in: bool = False,
    budget: Budget | None = None,
) -> tuple[tuple[Variant, ...], tuple[str, ...]]:
    """Return the variants of an ablation, the base first, and what is to be said of them.

    Parameters
    ----------
    base
        A planner's name, a table as in a config, or a planner.
    swap
        By slot, or parameter (``crossover.rate``), what takes its place, one at a
        time. The base's own choice among them is the base.
    without
        Optional slots, members of a list (``termination.stagnation``) or objectives
        (``objectives.energy``) that are left out, one at a time.
    factorial
        All combinations, the base's own choices included, instead of one at a time.
    add_one_in
        Also the base without all of ``without`` at once, and with each alone of them.

    Raises
    ------
    ConfigError
        If a slot or a component is unknown, comes twice, or nothing is changed.
    """
    planner = compose(base)
    name = default_registry().name_of(type(planner)).rpartition("/")[2]
    swap, budget = dict(swap or {}), budget or Budget()
    factors: dict[str, list[tuple[str, Any]]] = {}
    notes = []
    for slot, values in swap.items():
        budget.refuse_swapped(slot)
        factors[slot], own = _levels(planner, slot, values)
        notes += [f"swap {slot}: {value} is the base's own" for value in own]
    for slot in without:
        if slot in factors:
            raise ConfigError(f"without {slot}: comes twice, or is swapped as well; allowed once")
        budget.refuse_swapped(slot)
        emptied = _changed(planner, slot, NONE, "without")
        if _table(emptied) == _table(planner):
            raise ConfigError(f"without {slot}: {name!r} has none")
        factors[slot] = [(NONE, NONE)]
    if not factors:
        raise ConfigError("found nothing to change, allowed --swap SLOT=COMPONENT,… and --without SLOT")
    variants = [Variant(name, planner)]
    if factorial:
        if add_one_in:
            raise ConfigError("add one in: is part of a full factorial already; leave one of them away")
        variants += _crossed(planner, factors)
    else:
        for slot, levels in factors.items():
            variants += [_variant(planner, {slot: level}) for level in levels]
        if add_one_in:
            variants += _added(planner, without)
    return tuple(variants), tuple(notes)


def comparison(planners: Iterable[str | Mapping[str, Any] | Planner] | Mapping[str, Any]) -> tuple[Variant, ...]:
    """Return the variants of a comparison: planners as they are, under their names or those of a mapping.

    Raises
    ------
    ConfigError
        If there is none, one is unknown, or one comes twice.
    """
    if isinstance(planners, Mapping) and "use" not in planners:
        return tuple(Variant(name, compose(planner)) for name, planner in planners.items())
    variants: list[Variant] = []
    for asked in [planners] if isinstance(planners, (str, Mapping, Planner)) else planners:
        planner = compose(asked)
        full = default_registry().name_of(type(planner))
        name = asked if isinstance(asked, str) else full.rpartition("/")[2]
        same = sum(v.name == name or v.name.startswith(f"{name} #") for v in variants)
        if same and not isinstance(asked, str):  # the same planner with other parameters
            name = f"{name} #{same + 1}"
        variants.append(Variant(name, planner))
    if not variants:
        raise ConfigError("planners: found none, allowed one or more")
    return tuple(variants)


def _levels(planner: Planner, slot: str, values: Sequence[Any]) -> tuple[list[tuple[str, Any]], list[str]]:
    """Return what takes a slot's place, each with its name, and the names of what stands there already."""
    if isinstance(values, (str, Mapping, Component)) or not isinstance(values, Iterable):
        values = [values]
    if not values:
        raise ConfigError(f"swap {slot}: found nothing, allowed SLOT=COMPONENT,…")
    levels: list[tuple[str, Any]] = []
    own: list[str] = []
    seen: dict[str, str] = {}
    for value in values:
        label, table = _label(value), _table(_changed(planner, slot, value, "swap"))
        key = repr(table)
        if key in seen:
            raise ConfigError(f"swap {slot}: found {label!r} twice{_alias(label, seen[key])}, allowed each once")
        seen[key] = label
        if table == _table(planner):
            own.append(label)
        else:
            levels.append((label, value))
    if not levels:
        raise ConfigError(f"swap {slot}: {own[0]!r} is the base's own; found nothing else to put there")
    return levels, own


def _alias(label: str, other: str) -> str:
    return "" if label == other else f" (also called {other!r})"


def _crossed(planner: Planner, factors: Mapping[str, Sequence[tuple[str, Any]]]) -> list[Variant]:
    """Return all combinations of levels but the base itself."""
    count = 1
    for levels in factors.values():
        count *= len(levels) + 1
    if count > MOST_VARIANTS:
        raise ConfigError(f"factorial: found {count} combinations, allowed at most {MOST_VARIANTS}")
    choices = [[None, *levels] for levels in factors.values()]
    found = []
    for chosen in product(*choices):
        changes = {slot: level for slot, level in zip(factors, chosen, strict=True) if level is not None}
        if changes:
            found.append(_variant(planner, changes))
    return found


def _added(planner: Planner, without: Sequence[str]) -> list[Variant]:
    """Return the planner without all of these slots, and with each alone of them."""
    if len(without) < 2:
        raise ConfigError("add one in: needs two or more --without SLOT")
    found = [_variant(planner, dict.fromkeys(without, (NONE, NONE)))]
    if len(without) > 2:  # of two, one alone is the other left out
        for kept in without:
            found.append(_variant(planner, {slot: (NONE, NONE) for slot in without if slot != kept}))  # noqa: PERF401
    return found


def _variant(planner: Planner, changes: Mapping[str, tuple[str, Any]]) -> Variant:
    parts = [f"without {slot}" if label == NONE else f"{slot}={label}" for slot, (label, _) in changes.items()]
    for slot, (label, value) in changes.items():
        planner = _changed(planner, slot, value, "without" if label == NONE else "swap")
    return Variant(", ".join(parts), planner, {slot: label for slot, (label, _) in changes.items()})


def _changed(planner: Planner, slot: str, value: Any, what: str) -> Planner:
    try:
        return override(planner, slot, value)
    except ConfigError as error:
        said = str(error)
        if value == NONE and f"is called {NONE!r}" in said:
            raise ConfigError(f"{what} {slot}: it cannot be empty") from error
        raise ConfigError(f"{what} {said if said.startswith(slot) else f'{slot}: {said}'}") from error


def _table(planner: Planner) -> dict[str, Any]:
    return freeze(planner)


def _label(value: Any) -> str:
    """Return what a study calls a component, a table or a number."""
    if isinstance(value, Component):
        other = {p.name: v for p in parameters(type(value)) if (v := getattr(value, p.name)) != p.default}
        value = {"use": default_registry().name_of(type(value)), **other}
    if isinstance(value, Mapping):
        rest = ", ".join(f"{k}={_label(v)}" for k, v in value.items() if k != "use")
        return f"{value.get('use', '')}({rest})" if rest else str(value.get("use", ""))
    if isinstance(value, (list, tuple)):
        return "+".join(map(_label, value))
    return str(value)


def _refuse_alike(variants: Sequence[Variant]) -> None:
    """Refuse two variants of one name, or two that are the same."""
    seen: dict[str, str] = {}
    names: set[str] = set()
    for variant in variants:
        if variant.name in names:
            raise ConfigError(f"found {variant.name!r} twice, allowed each once")
        names.add(variant.name)
        key = repr(_table(variant.planner))
        if key in seen:
            raise ConfigError(f"{variant.name!r} and {seen[key]!r} are the same, allowed each once")
        seen[key] = variant.name


def budgeted(design: Design, budget: Budget) -> Design:
    """Return the design with a budget that is known, in the planners of all variants."""
    variants = tuple(replace(v, planner=budget.applied(v.planner)) for v in design.variants)
    return replace(design, variants=variants, budget=budget)
