"""Section 4.4: the weights, by ratios of importance."""

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, ClassVar

import msgspec
import numpy as np

from pathloom import ConfigError, Floats, Problem, Terms, Weighting

Ratio = Annotated[float, msgspec.Meta(ge=1.0)]


@dataclass(frozen=True, kw_only=True)
class DelphiRatio(Weighting):
    """Weights that sum to 1, each so many times the next one.

    The paper calls this the Delphi weight method, but there are no experts and no
    rounds in it: it is a scale of ratios, of which table 1 names 1 (as important),
    1.2 (slightly more), 1.4 (more) and 1.6 (much more).
    """

    source: ClassVar[str] = "Hao et al. 2021, section 4.4, eqs. (21)-(25), table 1"

    ratios: tuple[Ratio, ...] = (1.2, 1.4)
    """I_k = w_k / w_(k+1), eq. (21): how much more each objective matters than the one after it."""

    def check(self, terms: Terms) -> None:
        if len(terms) != len(self.ratios) + 1:
            raise ConfigError(
                f"{self.name}: ratios is a list of one number fewer than there are objectives; "
                f"got {len(self.ratios)} for {len(terms)}: {', '.join(terms.labels)}"
            )

    def weights(self, terms: Terms, problem: Problem) -> Floats:
        return self._weights

    @cached_property
    def _weights(self) -> Floats:
        of_the_last = np.cumprod([1.0, *reversed(self.ratios)])[::-1]  # w_k / w_m, the products in eq. (22)
        return np.asarray(of_the_last / of_the_last.sum())  # eq. (24), then eq. (21) backwards
