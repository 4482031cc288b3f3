"""The contract kit: what every component promises, as checks that anybody can run on components of his own.

    @pytest.mark.parametrize(("component", "check"), checks_for(Jitter), ids=lambda one: one.name)
    def test_jitter(component, check):
        check(component)

`pathloom.testing.pytest` makes such tests of a whole package, ``pathloom plugins check`` needs no test at all.
"""

from pathloom.testing.check import Broken, Check, Inapplicable
from pathloom.testing.contract import CHECKS, Pair, checks_for

__all__ = ["CHECKS", "Broken", "Check", "Inapplicable", "Pair", "checks_for"]
