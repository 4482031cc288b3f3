"""Citing: what a study's statistics were published in."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from pathloom.kernel.citing import Work
from pathloom.study.statistics.summary import Summary

ACCENTS = str.maketrans({"á": r"{\'a}", "š": r"{\v{s}}"})
"""How TeX writes the letters of our authors."""


@dataclass(frozen=True, kw_only=True)
class Article:
    """What there is to say of an article, once."""

    key: str
    authors: tuple[str, ...]
    """Each as ``Family, Given``."""
    year: int
    title: str
    """Braces keep the capitals of names."""
    journal: str
    volume: int
    pages: tuple[int, int]

    @property
    def work(self) -> Work:
        """The article as it is cited."""
        return Work(self._text(), self._bibtex())

    def _text(self) -> str:
        names = ", ".join(map(_initials_first, self.authors))
        first, last = self.pages
        title = re.sub(r"[{}]", "", self.title)
        return f"{names} ({self.year}), {title}, {self.journal} {self.volume}, {first}-{last}"

    def _bibtex(self) -> str:
        first, last = self.pages
        fields = {
            "author": " and ".join(self.authors).translate(ACCENTS),
            "title": self.title,
            "journal": self.journal,
            "volume": self.volume,
            "pages": f"{first}--{last}",
            "year": self.year,
        }
        lines = ",\n".join(f"  {name:7} = {{{value}}}" for name, value in fields.items())
        return f"@article{{{self.key},\n{lines}\n}}\n"


def _initials_first(name: str) -> str:
    """Return ``Mann, Henry B.`` as ``H. B. Mann``."""
    family, _, given = name.partition(", ")
    return " ".join([*(f"{word[0]}." for word in given.split()), family])


STATISTICS = {
    "wilson": Article(
        key="wilson1927",
        authors=("Wilson, Edwin B.",),
        year=1927,
        title="Probable Inference, the Law of Succession, and Statistical Inference",
        journal="Journal of the American Statistical Association",
        volume=22,
        pages=(209, 212),
    ),
    "signed rank": Article(
        key="wilcoxon1945",
        authors=("Wilcoxon, Frank",),
        year=1945,
        title="Individual Comparisons by Ranking Methods",
        journal="Biometrics Bulletin",
        volume=1,
        pages=(80, 83),
    ),
    "rank sum": Article(
        key="mann1947",
        authors=("Mann, Henry B.", "Whitney, Donald R."),
        year=1947,
        title="On a Test of Whether One of Two Random Variables is Stochastically Larger than the Other",
        journal="Annals of Mathematical Statistics",
        volume=18,
        pages=(50, 60),
    ),
    "stratified rank sum": Article(
        key="vanelteren1960",
        authors=("van Elteren, P. H.",),
        year=1960,
        title="On the Combination of Independent Two-sample Tests of {Wilcoxon}",
        journal="Bulletin of the International Statistical Institute",
        volume=37,
        pages=(351, 361),
    ),
    "Friedman": Article(
        key="friedman1937",
        authors=("Friedman, Milton",),
        year=1937,
        title="The Use of Ranks to Avoid the Assumption of Normality Implicit in the Analysis of Variance",
        journal="Journal of the American Statistical Association",
        volume=32,
        pages=(675, 701),
    ),
    "holm": Article(
        key="holm1979",
        authors=("Holm, Sture",),
        year=1979,
        title="A Simple Sequentially Rejective Multiple Test Procedure",
        journal="Scandinavian Journal of Statistics",
        volume=6,
        pages=(65, 70),
    ),
    "a12": Article(
        key="vargha2000",
        authors=("Vargha, András", "Delaney, Harold D."),
        year=2000,
        title="A Critique and Improvement of the {CL} Common Language Effect Size Statistics of {McGraw} and {Wong}",
        journal="Journal of Educational and Behavioral Statistics",
        volume=25,
        pages=(101, 132),
    ),
    "ranks": Article(
        key="demsar2006",
        authors=("Demšar, Janez",),
        year=2006,
        title="Statistical Comparisons of Classifiers over Multiple Data Sets",
        journal="Journal of Machine Learning Research",
        volume=7,
        pages=(1, 30),
    ),
}
"""The statistics, by what calls for them."""


def statistics(summary: Summary) -> Iterator[tuple[str, Work]]:
    """Yield what the statistics of a summary were published in, with what each stands for."""
    tests = {pair.test for it in summary.comparisons for pair in it.pairs} | {it.omnibus for it in summary.comparisons}
    many = any(len(it.pairs) > 1 for it in summary.comparisons)
    asked = {"wilson": True, "holm": many, "a12": bool(summary.comparisons)}
    asked["ranks"] = any(it.ranking is not None for it in summary.comparisons)
    yield from ((name, article.work) for name, article in STATISTICS.items() if asked.get(name, name in tests))
