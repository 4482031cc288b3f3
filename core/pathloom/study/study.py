"""Study: what was planned, and what has been found so far."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import nullcontext
from dataclasses import dataclass, fields
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from pathloom.kernel.planner import Planner
from pathloom.paths.cell_paths import Path as Cells
from pathloom.paths.problem import PathProblem
from pathloom.study import exporting
from pathloom.study.budget import Budget
from pathloom.study.errors import StudyError
from pathloom.study.lock import Lock
from pathloom.study.row import Row, RunHistory
from pathloom.study.session import Crew, Session, Watch, Workers, check_versions
from pathloom.study.store import MEMORY, References, Store, unpacked
from pathloom.study.table import html

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pathloom.study.statistics.summary import Summary


@dataclass(frozen=True)
class Progress:
    """How far a study is."""

    kind: str
    total: int
    """Runs that are planned."""
    done: int
    variants: Mapping[str, Mapping[str, int]]
    """By variant: how many runs ended how."""
    instances: int
    runs: int
    """Runs planned of each variant on each instance."""
    budget: str
    """What every run may spend, in words."""

    @property
    def complete(self) -> bool:
        """Whether nothing is left to do."""
        return self.done >= self.total


class Study:
    """What was planned, and what has been found so far.

    ``pathloom.ablate`` and ``pathloom.compare`` make one; ``Study.open`` reads one
    from its file. It is a context manager that closes the file.
    """

    def __init__(self, store: Store, planners: Mapping[str, Planner] | None = None) -> None:
        self._store = store
        self._planners = dict(planners or {})
        self.facts: Mapping[str, Any] = store.facts()
        """What is written down about the study as a whole."""
        if not self.facts:
            raise StudyError(f"{store.name}: found a study that never began, allowed one with a design")

    @classmethod
    def open(cls, path: str | Path) -> "Study":
        """Return the study in a file, to be read or resumed.

        Raises
        ------
        StudyError
            If there is none, it is damaged, or was written by a newer pathloom.
        """
        store = Store(path)
        try:
            return cls(store)
        except BaseException:
            store.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        self._store.close()

    def __len__(self) -> int:
        """Return how many runs are over."""
        return self._store.count()

    @property
    def name(self) -> str:
        """The file, or ``:memory:``."""
        return self._store.name

    @property
    def kind(self) -> str:
        """``ablate``, ``compare`` or ``tune``."""
        return str(self.facts["kind"])

    @property
    def budget(self) -> Budget:
        """What every run may spend."""
        return Budget(self.facts["budget"]["of"], self.facts["budget"]["limit"])

    @property
    def variants(self) -> dict[str, dict[str, Any]]:
        """The complete configs of the variants by name, in order; of an ablation, the base comes first."""
        return self._store.configs()

    @property
    def changes(self) -> dict[str, dict[str, str]]:
        """By variant what it has in place of the base's own, by slot."""
        return self._store.changes()

    @property
    def instances(self) -> dict[str, References]:
        """What is known of each instance, by name, in order."""
        return {name: self._store.references(number) for name, number in self._store.instance_ids().items()}

    @property
    def versions(self) -> list[dict[str, Any]]:
        """Versions and machines with which the runs were made; more than one where it was continued elsewhere."""
        return self._store.environments()

    @property
    def status(self) -> Progress:
        """How far the study is."""
        variants = self._store.statuses()
        instances, runs = len(self._store.instance_ids()), int(self.facts["runs"])
        return Progress(
            kind=self.kind, total=len(variants) * instances * runs, done=len(self), variants=variants,
            instances=instances, runs=runs, budget=str(self.budget),
        )  # fmt: skip

    def each(self) -> Iterator[Row]:
        """Yield the runs that are over, by instance, seed and variant."""
        return self._store.rows()

    def rows(self) -> list[Row]:
        """Return the runs that are over, by instance, seed and variant."""
        return list(self.each())

    def history(self, row: Row) -> RunHistory | None:
        """Return what a run was like on its way; ``None`` where nothing is known."""
        blob = self._store.trace(row.variant, row.map, row.seed)[0]
        if blob is None:
            return None
        found = unpacked(blob)

        def column(name: str, kind: type) -> NDArray[Any]:
            return np.array([np.inf if v is None else v for v in found.get(name, ())], kind)

        counts = ("evaluations", "answer_evaluations")
        return RunHistory(
            **{f.name: column(f.name, np.int64 if f.name in counts else np.float64) for f in fields(RunHistory)}
        )

    def path(self, row: Row) -> Cells | None:
        """Return the path (k, 2) that a run found; of a front, the shortest one."""
        blob = self._store.trace(row.variant, row.map, row.seed)[1]
        return None if blob is None else np.array(unpacked(blob), np.int64).reshape(-1, 2)

    def front(self, row: Row) -> dict[str, Any] | None:
        """Return the front that a run found: ``objectives`` (names), ``values`` (n, m), ``paths`` (n of (k, 2))."""
        blob = self._store.trace(row.variant, row.map, row.seed)[2]
        if blob is None:
            return None
        found = unpacked(blob)
        paths = [np.array(path, np.int64).reshape(-1, 2) for path in found["paths"]]
        return {**found, "values": np.array(found["values"], np.float64), "paths": paths}

    def problem(self, instance: str | Row) -> PathProblem:
        """Return the problem of an instance, or of a run's."""
        return self._store.problem(instance.map if isinstance(instance, Row) else instance)

    def planner(self, variant: str | Row) -> Planner:
        """Return the planner of a variant, or of a run's."""
        name = variant.variant if isinstance(variant, Row) else variant
        return self._planners[name] if name in self._planners else self._store.planner(name)

    def summary(self, *, baseline: str | None = None, alpha: float = 0.05) -> "Summary":
        """Return what the runs show: success rates, medians, comparisons, verdicts.

        Parameters
        ----------
        baseline
            The variant that all others are compared with; by default the base of an
            ablation or of tuning, and of a comparison all pairs.
        alpha
            Level of the tests.

        Raises
        ------
        ConfigError
            If the study has no runs yet, or no variant has the name.
        """
        from pathloom.study.report.report import summarised

        return summarised(self, baseline, alpha)

    def plot(self, file: Any = None, *, figure: str | None = None, dark: bool = False) -> "Figure":
        """Draw one figure of what the runs show; save to ``file`` if one is given.

        Parameters
        ----------
        file
            ``.png``, ``.svg`` or ``.pdf``.
        figure
            ``ranks`` (critical difference), ``spread`` (every run), ``convergence``,
            ``targets`` (reached by so many evaluations), ``profile`` (performance
            profile) or ``effects`` (of factors); by default the first that the runs allow.
        dark
            For dark ground.

        Raises
        ------
        StudyError
            If there is no such figure, or the runs do not allow it yet.
        ConfigError
            If the study has no runs yet.
        """
        from pathloom.draw import save
        from pathloom.draw.study import Sheet
        from pathloom.study.report.figures import figures

        seen = []
        for plot in figures(self, self.summary(), self.rows(), Sheet(width=3.7, dark=dark)):
            seen.append(plot.name)
            if figure in (None, plot.name):
                if file is not None:
                    save(plot.figure, file)
                return plot.figure
        raise StudyError(f"figure: found {figure!r}, allowed of these runs {', '.join(seen) or 'none'}")

    def _repr_html_(self) -> str:
        """Return how far the study is, for notebooks."""
        status = self.status
        endings = sorted({ending for counts in status.variants.values() for ending in counts})
        return html(
            ("variant", *endings),
            ((name, *(str(counts.get(ending, 0)) for ending in endings)) for name, counts in status.variants.items()),
            f"{status.kind}: {status.done} of {status.total} runs, {status.instances} maps, {status.budget} each",
        )

    def export(self, *, csv: str | Path | None = None, parquet: str | Path | None = None) -> int:
        """Write all runs to a file, or to two; return how many there are."""
        count = 0
        if csv is not None:
            count = exporting.to_csv(self.each(), csv)
        if parquet is not None:
            count = exporting.to_parquet(self.each(), parquet)
        return count

    def resume(
        self, workers: int | None = None, *, dask: str | None = None, mixed: bool = False, watch: Watch | None = None
    ) -> Self:
        """Carry out the runs that are missing.

        Parameters
        ----------
        workers
            Processes on this machine; by default one for each core.
        dask
            Address of a Dask scheduler, instead.
        mixed
            Go on even if the versions of pathloom, Python, numpy, numba or a plugin
            are others than those that the study began with.
        watch
            Told how far it is.

        Raises
        ------
        StudyError
            If another process is adding runs to the study, or the versions differ.
        """
        return self.resumed(Workers(workers, dask), mixed=mixed, watch=watch)

    def resumed(
        self, workers: Workers, *, mixed: bool = False, watch: Watch | None = None,
        check: Callable[[], None] = lambda: None,
    ) -> Self:  # fmt: skip
        """Carry out the runs that are missing; ``check`` is called all the time, and may raise to end everything."""
        lock = nullcontext() if self.name == MEMORY else Lock(Path(self.name))
        with lock, Crew(workers, self.variants.values()) as crew:
            self._store.check()
            check_versions(self._store, self.facts, mixed=mixed)
            Session(self._store, self.planner, crew, watch, check).work()
        return self
