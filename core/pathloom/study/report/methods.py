"""Methods: what was varied, and how, in sentences made from what the study wrote down."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from pathloom.errors import PathloomError
from pathloom.kernel.citing import Work, works_of
from pathloom.study.report.citing import statistics
from pathloom.study.report.figures import own
from pathloom.study.statistics.summary import Summary
from pathloom.study.study import Study

STARTS = {"strict": "a segment may not touch an obstacle cell, not even at its corner",
          "no-squeeze": "a segment may graze a corner, but not pass between two obstacles that share one",
          "allow": "only the interior of an obstacle cell blocks"}  # fmt: skip


@dataclass(frozen=True)
class Change:
    """One thing that is varied."""

    slot: str
    own: str
    """What the base has."""
    others: tuple[str, ...]


def changes(study: Study) -> list[Change]:
    """Return what is varied, by slot."""
    found: dict[str, list[str]] = {}
    for changed in study.changes.values():
        for slot, label in changed.items():
            if label not in found.setdefault(slot, []):
                found[slot].append(label)
    base = next(iter(study.variants.values()))
    return [Change(slot, own(base, slot), tuple(labels)) for slot, labels in found.items()]


def question(study: Study) -> str:
    """Return what the study asks: in its own words, where it has some."""
    words = said_of(study, "question")
    if words:
        return words
    names, varied = list(study.variants), changes(study)
    if study.kind == "compare" or not varied:
        return f"How do {_and(names)} compare?" if len(names) > 1 else f"How good is {names[0]}?"
    slots = _and([change.slot for change in varied])
    if study.kind == "tune":
        return f"Which values of {slots} suit {names[0]}?"
    if len(varied) == 1 and set(varied[0].others) == {"none"}:
        return f"What does {slots} do for {names[0]}?"
    return f"What does the choice of {slots} do to {names[0]}?"


def said_of(study: Study, what: str) -> str:
    """Return what the notes of a study say of ``question`` or ``source``."""
    begin = f"{what}: "
    return next((note.removeprefix(begin) for note in study.facts["notes"] if note.startswith(begin)), "")


@dataclass(frozen=True)
class Methods:
    """The paragraph, and the works that it cites, in order."""

    sentences: tuple[str, ...]
    works: tuple[Work, ...]


def methods(study: Study, summary: Summary) -> Methods:
    """Return how the study was made."""
    built, absent = [], []
    for name in study.variants:
        try:
            built.append(study.planner(name))
        except PathloomError:  # a plugin is not installed here; the study can be read all the same
            absent.append(name)
    used = works_of(built)
    tools = list(statistics(summary))
    works = [*used, *(work for _, work in tools)]
    cited = {name: works.index(work) + 1 for name, work in tools}
    said = [*_Telling(study, summary, used, cited).all()]
    if absent:
        said.append(f"Parts of {_and(absent)} are not installed where this was written, and are not cited.")
    return Methods(tuple(said), tuple(works))


class _Telling:
    def __init__(self, study: Study, summary: Summary, used: Sequence[Work], cited: dict[str, int]) -> None:
        self.study, self.summary, self.used, self.cited = study, summary, used, cited

    def cite(self, *names: str) -> str:
        found = [str(self.cited[name]) for name in names if name in self.cited]
        return f" [{', '.join(found)}]" if found else ""

    def all(self) -> Iterator[str]:
        yield from self.subjects()
        yield from self.instances()
        yield from self.runs()
        yield from self.analysis()

    def subjects(self) -> Iterator[str]:
        study, names = self.study, list(self.study.variants)
        refs = f" [{', '.join(str(i + 1) for i in range(len(self.used)))}]" if self.used else ""
        if study.kind == "compare":
            yield f"We compared {_count(len(names), 'planner')}: {_and(names)}{refs}."
            return
        yield f"Starting from the planner {names[0]}{refs}, we made {_count(len(names) - 1, 'variant')}."
        for change in changes(study):
            yield f"In the place of {change.slot} = {change.own} stood {_or(change.others)}."

    def instances(self) -> Iterator[str]:
        study, names = self.study, list(self.study.instances)
        problems = [study.problem(name) for name in names[:200]]
        sizes = sorted({(it.grid.height, it.grid.width) for it in problems})
        spans = [f"{h} × {w}" for h, w in sizes]
        span = spans[0] if len(spans) == 1 else _and(spans) if len(spans) < 4 else f"{spans[0]} to {spans[-1]}"
        yield f"All met the same {_count(len(names), 'map')} ({_few(names)}; {span} cells)."
        for corners in sorted({it.corners for it in problems}):
            yield f"Corner policy {corners}: {STARTS[corners]}."
        radius = max(it.radius for it in problems)
        if radius > 0.0:
            yield f"Obstacles were grown by the robot's radius, up to {radius:g}."

    def runs(self) -> Iterator[str]:
        facts, study = self.study.facts, self.study
        first, last = facts["seed"], facts["seed"] + facts["runs"] - 1
        seeds = f"seed {first}" if first == last else f"seeds {first} to {last}"
        yield (
            f"Each ran {_count(facts['runs'], 'time')} on each map, with {seeds}, the same for all: "
            f"{study.status.done} runs of {study.status.total} that were planned."
        )
        budget = study.budget
        if budget.of == "own":
            yield "Each kept the limits that it brings, so that some spent more than others."
        else:
            yield f"Every run could spend {budget}; ends because of what was reached stayed as each variant has them."
        if facts["time_limit"] is not None:
            yield f"A run answered with its best after {facts['time_limit']:g} s."
        yield (
            "Every path was checked by exact integer arithmetic. Gaps are length through optimum, less one; optima are "
            "exact, over all paths along cell centres (any-angle) and over steps to the 8 neighbours (grid)."
        )

    def analysis(self) -> Iterator[str]:
        settings = self.summary.settings
        yield f"Success rates have 95 % Wilson intervals{self.cite('wilson')}."
        tests = {pair.test for it in self.summary.comparisons for pair in it.pairs}
        yield from (
            sentence
            for test, sentence in (
                ("signed rank", "Medians over runs were compared map by map, by Wilcoxon's signed rank test{}."),
                ("stratified rank sum", "With few maps, runs were compared within maps, by van Elteren's test{}."),
                ("rank sum", "On one map, runs were compared by the rank sum test{}."),
                ("Fisher", "Success on one map was compared by Fisher's exact test{}."),
            )
            if test in tests
            for sentence in [sentence.format(self.cite(test))]
        )
        if any(it.omnibus == "Friedman" for it in self.summary.comparisons):
            yield f"Whether any variants differ was asked by Friedman's test first{self.cite('Friedman', 'ranks')}."
        if tests:
            holm = ""
            if "holm" in self.cited:
                holm = f", and p was corrected by Holm's method within each metric{self.cite('holm')}"
            yield (
                f"The level is {settings.alpha:g}{holm}. Effect sizes are differences of medians and A12"
                f"{self.cite('a12')}, with bootstrap intervals of {settings.resamples} samples. A run without a path "
                "ranks worst."
            )
        for it in self.study.versions:
            yield f"Runs were made with pathloom {it['pathloom']}, Python {it['python']} and NumPy {it['numpy']}."


def entries(works: Sequence[Work]) -> str:
    """Return the BibTeX of works."""
    return "\n".join(work.bibtex for work in works if work.key)


def _count(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"


def _and(words: Sequence[str], last: str = "and") -> str:
    words = [f"“{word}”" if "," in word else word for word in words]
    if len(words) > 12:
        words = [*words[:11], f"{len(words) - 11} more"]
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}" if words else ""


def _or(words: Sequence[str]) -> str:
    return _and(["nothing" if word == "none" else word for word in words], "or")


def _few(names: Sequence[str]) -> str:
    return ", ".join(names) if len(names) <= 6 else f"{', '.join(names[:5])}, … {names[-1]}"
