"""Policies against each other in the closed loop: the same maps, paths, hazards and noise, and a study's statistics."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from pathloom.kernel.compose import freeze
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.registry import default_registry
from pathloom.local.drivers.driver import Driver
from pathloom.local.driving import ClosedLoop, Episode
from pathloom.local.policy import Decide
from pathloom.result import Result, versions
from pathloom.study.instances import Instance
from pathloom.study.statistics.comparing import Comparison, Settings, compare
from pathloom.study.statistics.describing import Rate
from pathloom.study.statistics.metrics import Metric
from pathloom.study.statistics.verdicts import Verdict, verdicts

SCHEMA = "pathloom.policy-drive/1"

UNHURT = Metric("unhurt", "share of drives without a collision", "more", "%", 1, yes_or_no=True, short="unhurt")
ARRIVED = Metric("arrived", "share of drives that arrive", "more", "%", 1, yes_or_no=True, short="arrived")
SECONDS = Metric("seconds", "time to the goal", unit="s", digits=1, short="time")
CLEARANCE = Metric("min_clearance", "least clearance", "more", "m", 3, short="clearance")
METRICS = (UNHURT, ARRIVED, SECONDS, CLEARANCE)


@dataclass(frozen=True)
class Team:
    """Who drives: a driver, and the policy that it asks."""

    driver: Driver
    decide: Decide | None = None
    facts: Mapping[str, Any] = field(default_factory=dict)
    """What a document says of the policy and its training."""


@dataclass(frozen=True)
class Drives:
    """All episodes of a comparison."""

    teams: Mapping[str, Team]
    instances: tuple[Instance, ...]
    paths: tuple[Result, ...]
    """The global path on each of them."""
    loop: ClosedLoop
    seed: int
    episodes: Mapping[str, tuple[tuple[Episode, ...], ...]]
    """For each team, map by map, the episodes of the seeds from ``seed`` on; equal seeds meet equal hazards."""

    def all_of(self, name: str) -> list[Episode]:
        """Return all episodes of a team."""
        return [episode for of_map in self.episodes[name] for episode in of_map]

    def rate(self, name: str, metric: Metric) -> Rate:
        """Return how many of a team's episodes have something, with its Wilson interval."""
        costs = np.array([_cost(episode, metric) for episode in self.all_of(name)])
        return Rate.of(int((costs < 0.0).sum()), len(costs))

    def collisions(self, name: str) -> Rate:
        """Return how many of a team's episodes end in a collision, with its Wilson interval."""
        unhurt = self.rate(name, UNHURT)
        return Rate.of(unhurt.runs - unhurt.found, unhurt.runs)

    def median(self, name: str, metric: Metric) -> float | None:
        """Return the median of a team's episodes that have a value."""
        costs = np.array([_cost(episode, metric) for episode in self.all_of(name)])
        known = costs[np.isfinite(costs)]
        return float(np.median(known)) * metric.sign + 0.0 if len(known) else None  # + 0.0: no −0

    def compared(self, alpha: float = 0.05) -> tuple[tuple[Comparison, ...], tuple[Verdict, ...]]:
        """Return the comparisons of all teams in every metric, map by map, and what they say in sentences."""
        if len(self.teams) < 2:
            return (), ()
        settings = Settings(alpha=alpha, seed=self.seed)
        found = tuple(compare(list(self.teams), self._costs(metric), metric, settings) for metric in METRICS)
        return found, tuple(verdict for it in found for verdict in verdicts(it, alpha))

    def _costs(self, metric: Metric) -> Floats:
        """Return what each episode costs, (teams, maps, episodes)."""
        return np.array([[[_cost(e, metric) for e in of_map] for of_map in self.episodes[n]] for n in self.teams])

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON document, schema ``pathloom.policy-drive/1``; what a clock says stands in ``timing``."""
        comparisons, said = self.compared()
        return {
            "schema": SCHEMA,
            "seed": self.seed,
            "maps": [
                {"name": it.name, "sha256": it.problem.grid.sha256, "start": list(it.problem.ends[0]),
                 "goal": list(it.problem.ends[1]), "planner": path.planner, "length": path.length}
                for it, path in zip(self.instances, self.paths, strict=True)
            ],
            "loop": freeze(self.loop, default_registry()),
            "policies": {name: self._document(name, team) for name, team in self.teams.items()},
            "comparisons": [{**asdict(it), "metric": it.metric.name} for it in comparisons],
            "verdicts": [verdict.text for verdict in said],
            "timing": {name: self.timing(name) for name in self.teams},
            "versions": dict(versions()),
        }  # fmt: skip

    def timing(self, name: str) -> dict[str, float | None]:
        """Return control steps a second, and milliseconds a step for sensing and deciding."""
        each = self.all_of(name)
        steps, working = sum(e.steps for e in each), sum(e.working for e in each)
        thinking = sum(e.thinking for e in each)
        return {
            "steps_per_second": steps / working if working else None,
            "milliseconds_per_decision": 1000.0 * thinking / steps if steps else None,
        }

    def _document(self, name: str, team: Team) -> dict[str, Any]:
        each = self.all_of(name)
        steps = sum(e.steps for e in each)
        rates = {"collision_rate": self.collisions(name), "arrival_rate": self.rate(name, ARRIVED)}
        return {
            "driver": freeze(team.driver, default_registry()),
            **team.facts,
            "ends": dict(Counter(e.end for e in each)),
            **{key: {**asdict(rate), "share": rate.share} for key, rate in rates.items()},
            "seconds": self.median(name, SECONDS),
            "min_clearance": self.median(name, CLEARANCE),
            "progress": float(np.mean([e.progress for e in each])),
            "decided": sum(e.decided for e in each) / steps if steps else 0.0,
            "episodes": [
                {
                    "map": it.name,
                    "seed": self.seed + k,
                    **{key: value for key, value in vars(e).items() if key not in UNTOLD},
                }
                for it, of_map in zip(self.instances, self.episodes[name], strict=True)
                for k, e in enumerate(of_map)
            ],
        }


UNTOLD = ("thinking", "working", "frames")
"""Fields of an episode that its document leaves out: pictures, and what depends on the clock."""


def drive(
    teams: Mapping[str, Team],
    instances: Sequence[Instance],
    paths: Sequence[Result],
    *,
    loop: ClosedLoop = ClosedLoop(),
    episodes: int = 40,
    seed: int = 0,
    tell: Callable[[str], None] = lambda _: None,
) -> Drives:
    """Let every team drive the same episodes along the paths, one path a map, and return how they ended."""
    found: dict[str, list[tuple[Episode, ...]]] = {name: [] for name in teams}
    for instance, path in zip(instances, paths, strict=True):
        for name, team in teams.items():
            tell(f"{name}, {instance.name}")
            drives = (
                loop.drive(instance.problem.grid, path.path, team.driver, team.decide, seed=seed + k)  # type: ignore[arg-type]
                for k in range(episodes)
            )
            found[name].append(tuple(drives))
    whole = {name: tuple(each) for name, each in found.items()}
    return Drives(dict(teams), tuple(instances), tuple(paths), loop, seed, whole)


def _cost(episode: Episode, metric: Metric) -> float:
    """Return what an episode costs, less being better; infinitely much where it has no value."""
    if metric is UNHURT:
        return 0.0 if episode.end == "collided" else metric.sign
    if metric is ARRIVED:
        return metric.sign if episode.end == "reached" else 0.0
    if metric is SECONDS:
        return episode.seconds if episode.end == "reached" else np.inf
    return metric.sign * episode.min_clearance
