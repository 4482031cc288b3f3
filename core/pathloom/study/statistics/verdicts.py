"""What the tests say, in sentences."""

from collections.abc import Iterator
from dataclasses import dataclass

from pathloom.study.statistics.comparing import Comparison, Pair
from pathloom.study.statistics.effects import Estimate, size_of
from pathloom.study.statistics.metrics import Metric

TESTS = {
    "signed rank": "Wilcoxon signed rank",
    "stratified rank sum": "van Elteren",
    "rank sum": "Mann-Whitney",
    "Fisher": "Fisher's exact test",
}


@dataclass(frozen=True)
class Verdict:
    """One sentence about one metric: of all variants, or of two."""

    metric: str
    variants: tuple[str, ...]
    shown: bool
    """Whether an effect was shown."""
    text: str


def verdicts(comparison: Comparison, alpha: float) -> Iterator[Verdict]:
    """Yield what a comparison says: first whether any differ, then who differs from whom."""
    metric = comparison.metric
    pairs = comparison.pairs
    if len(pairs) > 1 and all(pair.test != "none" and pair.ties == pair.instances and pair.p == 1.0 for pair in pairs):
        where = _instances(comparison.instances)
        text = f"{_head(metric)}: no effect shown; all {len(_names(comparison))} variants are equal on {where}."
        yield Verdict(metric.name, _names(comparison), shown=False, text=text)
        return
    if comparison.p is not None and comparison.omnibus is not None:
        shown = comparison.p < alpha
        everyone = tuple(comparison.ranking.ranks) if comparison.ranking else _names(comparison)
        what = "the variants differ" if shown else "no difference between the variants shown"
        best = ""
        if shown and comparison.ranking is not None:
            name, place = next(iter(comparison.ranking.ranks.items()))
            best = f"; best average rank: {name}, {place:.2f}"
        how = f"{comparison.omnibus}, {_p(comparison.p)}, {_instances(comparison.instances)}"
        yield Verdict(metric.name, everyone, shown, f"{_head(metric)}: {what} ({how}){best}.")
    for pair in comparison.pairs:
        yield _of(pair, metric, alpha, len(comparison.pairs))


def _of(pair: Pair, metric: Metric, alpha: float, pairs: int) -> Verdict:
    names, head = (pair.one, pair.other), _head(metric)
    if pair.test == "none":
        return Verdict(metric.name, names, shown=False, text=f"{head}: {pair.one} and {pair.other} share no value.")
    shown = pair.adjusted < alpha
    where = ("runs on " if pair.test != "signed rank" else "") + _instances(pair.instances)
    how = f"{TESTS[pair.test]}, {_p(pair.adjusted)}{' after Holm' if pairs > 1 else ''}, {where}"
    if not shown:
        seen = _unseen(pair, metric)
        text = f"{head}: no effect shown between {pair.one} and {pair.other} ({how}){seen}."
        return Verdict(metric.name, names, shown=False, text=text)
    better = _better(pair)
    one, other = names if better else names[::-1]
    effect = f"{how}; {_a12(pair, better=better)}"
    text = f"{head}: {one} is better than {other}{_by(pair, metric, better=better)} ({effect})."
    return Verdict(metric.name, names, shown=True, text=text)


def _better(pair: Pair) -> bool:
    """Return whether the first of the two is the better one: by instances won, else by runs won."""
    losses = pair.instances - pair.wins - pair.ties
    if pair.wins != losses:
        return pair.wins > losses
    return pair.a12.value is not None and pair.a12.value > 0.5


def _by(pair: Pair, metric: Metric, *, better: bool) -> str:
    """Return by how much, as the better one's value minus the other's."""
    it = pair.difference if better else _turned(pair.difference)
    if it.value is None:
        return ", which fails too often for a median"
    kind = "difference" if metric.yes_or_no and pair.test == "Fisher" else "median difference"
    return f": {kind} {metric.show_difference(it.value, it.low, it.high)}"


def _a12(pair: Pair, *, better: bool) -> str:
    it = pair.a12 if better else _turned(pair.a12, about=1.0)
    if it.value is None:
        return "A12 unknown"
    between = "" if it.low is None or it.high is None else f" [{it.low:.2f}, {it.high:.2f}]"
    return f"A12 {it.value:.2f}{between}, {size_of(it.value)}"


def _turned(it: Estimate, about: float = 0.0) -> Estimate:
    """Return the estimate seen from the other side."""
    value, low, high = (None if v is None else about - v + 0.0 for v in (it.value, it.low, it.high))
    return Estimate(value, high, low)


def _unseen(pair: Pair, metric: Metric) -> str:
    """Return what could have been seen."""
    if pair.ties == pair.instances and pair.test == "signed rank":
        return "; they are equal on every instance"
    seen = []
    if pair.detectable is not None:
        seen.append(f"{metric.number(pair.detectable)} {metric.apart}".strip())
    if pair.detectable_a12 is not None:
        seen.append(f"A12 {pair.detectable_a12:.2f}")
    if seen:
        return f"; smallest effect that could have been seen: {', '.join(seen)}"
    if pair.ties and pair.test == "signed rank":
        return f"; they are equal on {pair.ties} of {pair.instances} instances"
    return "; too few observations to say which effect could have been seen"


def _names(comparison: Comparison) -> tuple[str, ...]:
    return tuple(dict.fromkeys(name for pair in comparison.pairs for name in (pair.one, pair.other)))


def _head(metric: Metric) -> str:
    return metric.label[0].upper() + metric.label[1:]


def _instances(count: int) -> str:
    return "1 instance" if count == 1 else f"{count} instances"


def _p(p: float) -> str:
    return "p < 0.0001" if p < 1e-4 else f"p = {p:.4f}" if p < 0.01 else f"p = {p:.3f}"
