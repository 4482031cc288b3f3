"""Section 4.3.1: selection by layers."""

from dataclasses import dataclass
from typing import ClassVar

from pathloom.kernel.selection import ByLayers


@dataclass(frozen=True, kw_only=True)
class ThreeLayer(ByLayers):
    """Copy the best third twice and the middle third once, and drop the rest.

    The paper's "M/3 + mod(M/3)" means ⌊M/3⌋ + (M mod 3).
    """

    source: ClassVar[str] = "Li et al. 2021, section 4.3.1, fig. 4"
