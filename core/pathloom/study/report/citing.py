"""Citing: what a study's planners and statistics were published in."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from pathloom.kernel.component import members
from pathloom.kernel.planner import Planner
from pathloom.kernel.registry import Entry, default_registry
from pathloom.study.statistics.summary import Summary


@dataclass(frozen=True)
class Work:
    """Something published."""

    text: str
    """As it stands in a list of references."""
    bibtex: str
    """Empty where there is no entry."""


STATISTICS = {
    "wilson": Work(
        "E. B. Wilson (1927), Probable inference, the law of succession, and statistical inference, "
        "J. Am. Stat. Assoc. 22, 209-212",
        """\
@article{wilson1927,
  author  = {Wilson, Edwin B.},
  title   = {Probable Inference, the Law of Succession, and Statistical Inference},
  journal = {Journal of the American Statistical Association},
  volume  = {22},
  pages   = {209--212},
  year    = {1927}
}
""",
    ),
    "signed rank": Work(
        "F. Wilcoxon (1945), Individual comparisons by ranking methods, Biometrics Bulletin 1, 80-83",
        """\
@article{wilcoxon1945,
  author  = {Wilcoxon, Frank},
  title   = {Individual Comparisons by Ranking Methods},
  journal = {Biometrics Bulletin},
  volume  = {1},
  pages   = {80--83},
  year    = {1945}
}
""",
    ),
    "rank sum": Work(
        "H. B. Mann, D. R. Whitney (1947), On a test of whether one of two random variables is stochastically larger "
        "than the other, Ann. Math. Stat. 18, 50-60",
        """\
@article{mann1947,
  author  = {Mann, Henry B. and Whitney, Donald R.},
  title   = {On a Test of Whether One of Two Random Variables is Stochastically Larger than the Other},
  journal = {Annals of Mathematical Statistics},
  volume  = {18},
  pages   = {50--60},
  year    = {1947}
}
""",
    ),
    "stratified rank sum": Work(
        "P. H. van Elteren (1960), On the combination of independent two-sample tests of Wilcoxon, "
        "Bull. Int. Stat. Inst. 37, 351-361",
        """\
@article{vanelteren1960,
  author  = {van Elteren, P. H.},
  title   = {On the Combination of Independent Two-sample Tests of {Wilcoxon}},
  journal = {Bulletin of the International Statistical Institute},
  volume  = {37},
  pages   = {351--361},
  year    = {1960}
}
""",
    ),
    "Friedman": Work(
        "M. Friedman (1937), The use of ranks to avoid the assumption of normality implicit in the analysis of "
        "variance, J. Am. Stat. Assoc. 32, 675-701",
        """\
@article{friedman1937,
  author  = {Friedman, Milton},
  title   = {The Use of Ranks to Avoid the Assumption of Normality Implicit in the Analysis of Variance},
  journal = {Journal of the American Statistical Association},
  volume  = {32},
  pages   = {675--701},
  year    = {1937}
}
""",
    ),
    "holm": Work(
        "S. Holm (1979), A simple sequentially rejective multiple test procedure, Scand. J. Stat. 6, 65-70",
        """\
@article{holm1979,
  author  = {Holm, Sture},
  title   = {A Simple Sequentially Rejective Multiple Test Procedure},
  journal = {Scandinavian Journal of Statistics},
  volume  = {6},
  pages   = {65--70},
  year    = {1979}
}
""",
    ),
    "a12": Work(
        "A. Vargha, H. D. Delaney (2000), A critique and improvement of the CL common language effect size statistics "
        "of McGraw and Wong, J. Educ. Behav. Stat. 25, 101-132",
        """\
@article{vargha2000,
  author  = {Vargha, Andr{\\'a}s and Delaney, Harold D.},
  title   = {A Critique and Improvement of the {CL} Common Language Effect Size Statistics of {McGraw} and {Wong}},
  journal = {Journal of Educational and Behavioral Statistics},
  volume  = {25},
  pages   = {101--132},
  year    = {2000}
}
""",
    ),
    "ranks": Work(
        "J. Demšar (2006), Statistical comparisons of classifiers over multiple data sets, "
        "J. Mach. Learn. Res. 7, 1-30",
        """\
@article{demsar2006,
  author  = {Dem{\\v{s}}ar, Janez},
  title   = {Statistical Comparisons of Classifiers over Multiple Data Sets},
  journal = {Journal of Machine Learning Research},
  volume  = {7},
  pages   = {1--30},
  year    = {2006}
}
""",
    ),
}
"""The statistics, by what calls for them."""


def planners(used: Iterable[Planner]) -> list[Work]:
    """Return what planners and their parts were published in, each once; what has no reference is left out."""
    registry = default_registry()
    kinds, spaces = set(), set()
    for planner in used:
        kinds.add(type(planner))
        parts = [planner, *(part for _, part in members(planner)), *planner.terms.objectives()]
        spaces |= {registry.name_of(type(part)).partition("/")[0] for part in parts}
    entries = list(registry.all_entries(Planner))
    about = [entry for entry in entries if entry.component in kinds or entry.source.namespace in _of_one_paper(entries)]
    found: dict[str, Work] = {}
    for entry in sorted(about, key=lambda entry: entry.component not in kinds):
        bibtex, reference = getattr(entry.component, "bibtex", ""), getattr(entry.component, "reference", "")
        if reference and (entry.component in kinds or (bibtex and entry.source.namespace in spaces)):
            found.setdefault(bibtex or reference, Work(reference, bibtex))
    return list(found.values())


def _of_one_paper(entries: Iterable[Entry]) -> set[str]:
    """Return the plugins whose planners come from one paper: who uses a part of them cites it."""
    papers: dict[str, set[str]] = {}
    for entry in entries:
        papers.setdefault(entry.source.namespace, set()).add(getattr(entry.component, "bibtex", ""))
    return {space for space, entries_of in papers.items() if len(entries_of) == 1}


def statistics(summary: Summary) -> Iterator[tuple[str, Work]]:
    """Yield what the statistics of a summary were published in, with what each stands for."""
    tests = {pair.test for it in summary.comparisons for pair in it.pairs} | {it.omnibus for it in summary.comparisons}
    many = any(len(it.pairs) > 1 for it in summary.comparisons)
    asked = {"wilson": True, "holm": many, "a12": bool(summary.comparisons)}
    asked["ranks"] = any(it.ranking is not None for it in summary.comparisons)
    yield from ((name, work) for name, work in STATISTICS.items() if asked.get(name, name in tests))


def key_of(work: Work) -> str:
    """Return the key of an entry, or nothing."""
    found = re.match(r"\s*@\w+\{([^,\s]+)", work.bibtex)
    return found[1] if found else ""
