"""Section 2: what the paper says of its operators one by one, to be measured again."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pathloom import Bench, Claim, Evolution, Finding, PathProblem, any_angle_path, compiled, compose
from pathloom.claims import NEEDS_DATA, smaller, untestable, verdict
from pathloom.kernel.run import run
from pathloom.paths.collision import Exact
from pathloom.paths.numbering import Numbering
from pathloom_imaga.claims import (
    MAPS,
    OURS,
    ROWS,
    WITH_DELETION,
    generated,
    lengths,
    mean,
    near,
    on_all,
    seconds,
    settled,
)
from pathloom_imaga.collision import RecursiveMidpoint
from pathloom_imaga.probability import BandedAdaptive
from pathloom_imaga.sampling import RestrictedUniform


@dataclass(frozen=True, kw_only=True)
class Section21(Claim):
    """Coding, sampling, and the model of the step."""

    source: ClassVar[str] = "Zhang et al. 2023, sections 1.2 and 2.1, eqs. (1) to (11), fig. 3"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        yield _numbers()
        problems = generated(bench)
        ours, theirs = (
            [float(_first(planner, problem).mean()) for problem in problems] for planner in (OURS, "ga-imaga")
        )
        lead = smaller(ours, theirs)
        yield Finding(
            "section 2.1",
            "the sampler makes a better first population",
            f"mean length of 100 first paths {np.mean(ours):.1f}, GA's, a random cell of each row, "
            f"{np.mean(theirs):.1f}; on random maps, shorter on {lead}",
            verdict(lead.p < 0.05),
        )
        steps = np.arange(3, 9)
        grown = np.array([[_drawn(int(s), problem).mean() for s in steps] for problem in problems]).mean(axis=0)
        yield Finding(
            "fig. 3",
            "the larger the step, the longer the first paths",
            f"step {steps[0]} to {steps[-1]}: {', '.join(f'{length:.1f}' for length in grown)}",
            verdict((np.diff(grown) > 0).all()),
        )
        fit = np.polyval(np.polyfit(grown, steps, 2), 30.0)
        yield Finding(
            "eq. (11)",
            "step = −0.00064 x² + 0.0519 x − 0.9058 for paths of length x",
            f"at most {max(_printed_step(x) for x in np.arange(20.0, 100.0, 0.01)):.3f}, {_printed_step(30.0):.3f} for "
            f"x = 30; a step is at least 2, and our own fit gives {fit:.1f} for 30",
            verdict(False),
        )


def _numbers() -> Finding:
    rows = cols = 10
    number = np.arange(1, rows * cols + 1)
    row, col = rows - Numbering(rows, cols).cells(number)[:, 0], Numbering(rows, cols).cells(number)[:, 1] + 1
    fits = {
        "x = column, y = row": rows * col + row, "x = row, y = column": rows * row + col,
        "x = row − 1, y = column": rows * (row - 1) + col,
    }  # fmt: skip
    agree = {name: int((value == number).sum()) for name, value in fits.items()}
    text = f"of the 100 labels in fig. 1, {', '.join(f'{agree[name]} with {name}' for name in fits)}"
    return Finding("eq. (1)", "number = rows · x + y", text, verdict(agree["x = column, y = row"] == 100, True))


def _printed_step(x: float) -> float:
    return -0.00064 * x**2 + 0.0519 * x - 0.9058


def _first(planner: str, problem: PathProblem) -> Any:
    """Return the lengths of a first population of 100."""
    composed = compose(planner)
    assert isinstance(composed, Evolution)
    rows = composed.sampling.sample(problem, 100, np.random.default_rng(0))
    return compiled.measures.lengths(rows, problem.context.cols)


def _drawn(step: int, problem: PathProblem) -> Any:
    rows = RestrictedUniform(step=step).sample(problem, 100, np.random.default_rng(0))
    return compiled.measures.lengths(rows, problem.context.cols)


@dataclass(frozen=True, kw_only=True)
class Equation16(Claim):
    """The energy of tables 1 and 2, worked out from their turns and lengths."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.2, eq. (16), and tables 1 and 2"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        rows = np.array([row for table in ROWS.values() for row in table.values()])
        _, D, _, T, E = rows.T
        omega = (T - E * D) / (T - D)  # (1 − ω) T + ω D = E D
        yield Finding(
            "eq. (16)",
            "energy is ((1 − ω) T + ω D) / D, ω a weight",
            f"the eight rows of the tables need ω from {omega.min():.2f} to {omega.max():.2f}: none in [0, 1], no two "
            f"alike; (T + D) / D meets all within {np.abs(1 + T / D - E).max():.4f}",
            verdict(np.ptp(omega) < 0.01),
        )


@dataclass(frozen=True, kw_only=True)
class Section22(Claim):
    """Counting four neighbours."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.2"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        fittest: dict[str, Any] = {"use": OURS, "archive": "none", "refinement": "none"}  # what the count acts on
        beside = {"use": "obstacles-beside"}
        eight = {**fittest, "objectives": {"length": "length", "safety": beside, "energy": "energy-per-length"}}
        none = {**fittest, "objectives": {"length": "length", "energy": "energy-per-length"}}
        problems = generated(bench)
        slips = [
            [float(r.metrics["squeezes"] > 0) for r in on_all(bench, planner, problems)]
            for planner in (fittest, eight, none)
        ]
        share = [f"{100 * np.mean(s):.0f} %" for s in slips]
        yield Finding(
            "section 2.2",
            "counting obstacles among 4 neighbours keeps paths from slipping between two diagonal ones",
            f"{share[0]} of {len(slips[0])} fittest paths do before deletion, {share[1]} if 8 neighbours are counted, "
            f"{share[2]} if none ({len(problems)} random maps)",
            verdict(sum(slips[0]) == 0, smaller(slips[0], slips[2]).p < 0.05),
        )


@dataclass(frozen=True, kw_only=True)
class Section24(Claim):
    """Probabilities that adapt at both ends."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.4, eqs. (19) and (20)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problems = generated(bench)
        fixed = {
            "use": OURS, "crossover": {"probability": "none", "rate": 0.8},
            "mutation": {"probability": "none", "rate": 0.2},
        }  # fmt: skip
        ours, plain = on_all(bench, OURS, problems), on_all(bench, fixed, problems)
        fitness = [float(np.mean([r.history["best"][-1] for r in runs])) for runs in (ours, plain)]
        fitter = smaller([-r.history["best"][-1] for r in ours], [-r.history["best"][-1] for r in plain])
        yield Finding(
            "section 2.4",
            "adaptive probabilities make better populations than fixed ones, and faster",
            f"final fitness {fitness[0]:.3f}, with 0.8 and 0.2 throughout {fitness[1]:.3f}; higher in {fitter}; length "
            f"{mean(ours):.4f} and {mean(plain):.4f}; settled from generation {settled(ours):.0f} and "
            f"{settled(plain):.0f}",
            verdict(fitter.p < 0.05),
        )
        banded, full = (_nanoseconds(BandedAdaptive(base=0.8, thresh=thresh)) for thresh in (3, 2))
        generation = seconds(ours) / 50
        yield Finding(
            "section 2.4",
            "thresh saves computation: the middle of the population needs no formula",
            f"100 probabilities take {banded / 1e3:.1f} µs with a fixed middle, {full / 1e3:.1f} µs without; "
            f"a generation {generation * 1e6:.0f} µs",
            verdict(False, full - banded > 0.01 * generation * 1e9),
            timed=True,
        )


def _nanoseconds(probability: BandedAdaptive) -> float:
    from timeit import repeat

    fitness = np.random.default_rng(0).random(100)
    return 1e6 * min(repeat(lambda: probability.rates(fitness, 0.0), number=1000, repeat=5))


@dataclass(frozen=True, kw_only=True)
class Section25(Claim):
    """Greedy survival and adaptive evolution."""

    source: ClassVar[str] = "Zhang et al. 2023, sections 2.3 and 2.5, eq. (23)"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problems = generated(bench)
        ours = on_all(bench, OURS, problems)
        falls = sum(int((np.diff(r.history["generation_best"]) < 0).sum()) for r in ours)
        yield Finding(
            "sections 2.3, 2.5",
            "the population never goes back, since the best parent is kept",
            f"the best falls in {falls} of {50 * len(ours)} generations",
            verdict(falls == 0),
        )
        once = {"use": OURS, "control": "generational"}
        plain = on_all(bench, once, problems)
        spent = round(float(np.mean([r.budget["evaluations"] for r in ours])) / 100)
        longer = on_all(bench, {**once, "termination": [{"use": "max-generations", "limit": spent}]}, problems)
        fitness = [float(np.mean([r.history["best"][-1] for r in runs])) for runs in (ours, plain, longer)]
        fitter = [smaller([-r.history["best"][-1] for r in ours], [-r.history["best"][-1] for r in runs])
                  for runs in (plain, longer)]  # fmt: skip
        yield Finding(
            "section 2.5",
            "repeating a generation that has not improved shortens stagnation",
            f"fitness settled from generation {settled(ours):.0f}, without repetitions {settled(plain):.0f}; final "
            f"{fitness[0]:.3f} and {fitness[1]:.3f}, higher in {fitter[0]}; {fitness[2]:.3f} with as many evaluations "
            f"({spent} generations), higher in {fitter[1]}",
            verdict(settled(ours) < settled(plain) and fitter[1].p < 0.05, fitter[0].p < 0.05),
        )
        shorter = smaller(lengths(ours), lengths(plain))
        cost = np.mean([r.budget["evaluations"] for r in ours]) / np.mean([r.budget["evaluations"] for r in plain])
        yield Finding(
            "section 2.5",
            "adaptive evolution gives better paths",
            f"mean length {mean(ours):.4f} with {cost:.1f} times the evaluations, {mean(plain):.4f} without "
            f"repetitions; shorter in {shorter}",
            verdict(shorter.p < 0.05),
        )


@dataclass(frozen=True, kw_only=True)
class Section26(Claim):
    """Deletion."""

    source: ClassVar[str] = "Zhang et al. 2023, section 2.6, eqs. (24) and (25), fig. 8"

    def examine(self, bench: Bench) -> Iterator[Finding]:
        problems = generated(bench)
        ours = on_all(bench, OURS, problems)
        before = [bench.unrefined(r) for r in ours]
        saved = np.mean([1 - r.length / b["length"] for r, b in zip(ours, before, strict=True)])
        turns = [b["turns"] - r.metrics["turns"] for r, b in zip(ours, before, strict=True)]
        longer = sum(r.length > b["length"] + 1e-9 for r, b in zip(ours, before, strict=True))
        yield Finding(
            "section 2.6",
            "deletion takes redundant nodes out of the best path and smooths it",
            f"{100 * saved:.1f} % shorter and {np.mean(turns):.1f} turns fewer, means of {len(ours)}; "
            f"longer in {longer}, more turns in {sum(t < 0 for t in turns)}",
            verdict(longer == 0 and saved > 0 and np.mean(turns) > 0),
        )
        yield from _literal(bench)
        yield _midpoints(bench)


def _literal(bench: Bench) -> Iterator[Finding]:
    """Yield what comes out when points are deleted of the fittest path only, and that is the answer."""
    for obstacles, (file, ends) in MAPS.items():
        best, average = ROWS[obstacles][OURS][:2]
        says = f"deletion of the final best path gives {best}, mean {average} ({obstacles} obstacles)"
        problem = bench.recovered(file, **ends)
        if problem is None:
            yield untestable("section 2.6", says, NEEDS_DATA)
            continue
        runs = bench.runs({"use": OURS, "archive": "none"}, problem, bench.seeds(50, 10))
        measured = min(lengths(runs)), mean(runs)
        plain = bench.runs({**WITH_DELETION, "archive": "none"}, problem, bench.seeds(50, 10))
        text = (
            f"{measured[0]:.4f}, mean {measured[1]:.4f}, if the fittest path is taken for the best, as in fig. 9; "
            f"GA with the same deletion {min(lengths(plain)):.4f}, mean {mean(plain):.4f}"
        )
        reached = near(measured, (best, average), 0.01), near(measured, (best, average), 0.04)
        yield Finding("section 2.6", says, text, verdict(*reached))


def _midpoints(bench: Bench) -> Finding:
    rng, overlooked = np.random.default_rng(0), []
    for obstacles in (40, 80, 120, 160):
        problem = bench.problem(f"random-20:{obstacles}")
        free = np.argwhere(~problem.context.occupied)
        a, b = free[rng.integers(len(free), size=(2, 50000))]
        apart = np.abs(a - b).max(axis=1)
        near_by = (apart >= 2) & (apart <= 6)
        a, b = a[near_by], b[near_by]
        blocked = ~Exact().segments_free(a, b, problem)
        overlooked.append(100 * RecursiveMidpoint().segments_free(a, b, problem)[blocked].mean())
    unmended = compose(OURS, refinement={"use": "imaga/midpoint-point-deletion", "restore": False})
    problem = bench.problem("random-20:75")
    rows: list[Any] = [run(problem, unmended, seed).outcome.solution for seed in range(bench.seeds(20, 5))]
    found = [float(compiled.measures.lengths(np.array([row]), problem.context.cols)[0]) for row in rows]
    least = any_angle_path(problem)[0]
    return Finding(
        "eqs. (24), (25)",
        "midpoints of midpoints tell whether a segment meets an obstacle",
        f"{', '.join(f'{share:.0f}' for share in overlooked)} % of the blocked segments between cells 2 to 6 apart "
        f"pass with 10, 20, 30, 40 % of obstacles; then {sum(length < least - 1e-9 for length in found)} of "
        f"{len(found)} answers on random-20:75 are shorter than its shortest free path",
        verdict(max(overlooked) == 0),
    )
