"""Tables of a summary in LaTeX, for the package booktabs."""

from collections.abc import Iterable, Iterator, Sequence

from pathloom.study.statistics.metrics import METRICS
from pathloom.study.statistics.summary import Summary

SIGNS = {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
    "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "−": "$-$", "–": "--", "×": r"$\times$",
    "<": "$<$", ">": "$>$", "∞": r"$\infty$", "≥": r"$\geq$", "≤": r"$\leq$", "π": r"$\pi$",
}  # fmt: skip


def latex(summary: Summary) -> str:
    """Return tables of success and medians, and of the comparisons; the package booktabs is all they need."""
    tables = [_overall(summary)]
    tables += [_comparison(summary, name) for name in summary.metrics if summary.comparisons]
    return "\n".join(tables)


def escape(text: str) -> str:
    """Return text so that LaTeX prints it as it is."""
    return "".join(SIGNS.get(sign, sign) for sign in text)


def _overall(summary: Summary) -> str:
    shown = [METRICS[name] for name in summary.metrics if name != "success"]
    heads = ["variant", "found", "95\\,\\% interval", *(escape(metric.head) for metric in shown)]
    rows = []
    for it in summary.overall:
        rate = it.rate
        share = f"{rate.found}/{rate.runs}"
        values = [escape(metric.number(it.medians[metric.name])) for metric in shown]
        rows.append([escape(it.variant), share, f"[{rate.low:.2f}, {rate.high:.2f}]", *values])
    caption = (
        f"Success and medians over {_many(len(summary.instances))} of the medians over runs; "
        "a run without a path ranks worst, and -- says that the median falls among these."
    )
    return _table(caption, "l" + "r" * (len(heads) - 1), heads, rows)


def _comparison(summary: Summary, name: str) -> str:
    comparison = summary.comparison(name)
    metric = comparison.metric
    heads = ["variant", "against", "difference", "95\\,\\% interval", "$A_{12}$", "$p$", "$p$ (Holm)"]
    rows = [
        [
            escape(pair.one),
            escape(pair.other),
            escape(metric.number(pair.difference.value, signed=True)),
            escape(f"[{metric.number(pair.difference.low)}, {metric.number(pair.difference.high)}]"),
            "--" if pair.a12.value is None else f"{pair.a12.value:.2f}",
            _p(pair.p),
            _p(pair.adjusted),
        ]
        for pair in comparison.pairs
    ]
    unit = f", {escape(metric.apart)}" if metric.apart else ""
    test = comparison.pairs[0].test if comparison.pairs else "none"
    caption = (
        f"{escape(metric.label[0].upper() + metric.label[1:])}{unit}: {test} test over {_many(comparison.instances)}."
    )
    return _table(caption, "llrrrrr", heads, rows)


def _many(instances: int) -> str:
    return "1 instance" if instances == 1 else f"{instances} instances"


def _p(p: float) -> str:
    return "$<$0.0001" if p < 1e-4 else f"{p:.4f}"


def _table(caption: str, columns: str, heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    def lines() -> Iterator[str]:
        yield r"\begin{table}"
        yield r"\centering"
        yield rf"\caption{{{caption}}}"
        yield rf"\begin{{tabular}}{{{columns}}}"
        yield r"\toprule"
        yield " & ".join(heads) + r" \\"
        yield r"\midrule"
        for row in rows:
            yield " & ".join(row) + r" \\"
        yield r"\bottomrule"
        yield r"\end{tabular}"
        yield r"\end{table}"

    return "\n".join(lines()) + "\n"
