"""Form: what a component says of itself."""

import inspect
import re

from pathloom.kernel.component import Component
from pathloom.kernel.planner import Planner
from pathloom.testing.check import expect, promise


@promise("described")
def described(component: Component) -> None:
    """Its docstring begins with one line that ends as a sentence does, and its name is in kebab case."""
    about = (inspect.getdoc(type(component)) or "").partition("\n")[0]
    own = "__doc__" in vars(type(component)) and not about.startswith(f"{type(component).__name__}(")
    expect(own and about.endswith((".", ":")), f"expected a docstring whose first line is a sentence; found {about!r}")
    kebab = re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", component.name)
    expect(kebab, f"expected a name in kebab case, such as 'common-node'; found {component.name!r}")


@promise("cited", Planner, where=lambda planner: planner.reference)
def cited(component: Planner) -> None:
    """A planner with a reference says how faithful it is, what it assumes, and how it is cited."""
    levels = ("faithful", "standard", "reconstructed")
    expect(component.fidelity in levels, f"expected fidelity as one of {levels}; found {component.fidelity!r}")
    expect(component.assumptions, "expected assumptions: what the publication leaves open; found none")
    expect(component.bibtex.startswith("@"), f"expected an entry of BibTeX; found {component.bibtex[:30]!r}")


CHECKS = (described, cited)
