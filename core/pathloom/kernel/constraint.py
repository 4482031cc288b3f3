"""Constraint: what an answer must keep to, whatever its objectives are worth."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

from pathloom.kernel.component import Component
from pathloom.kernel.evaluation import Floats
from pathloom.kernel.problem import Problem
from pathloom.kernel.representation import Population


@dataclass(frozen=True, kw_only=True)
class Constraint(Component, ABC):
    """A condition on single individuals."""

    kind: ClassVar[str] = "constraint"

    @abstractmethod
    def violation(self, population: Population, problem: Problem) -> Floats:
        """Return for each of the n rows by how much it breaks the condition, (n,); 0 where it keeps to it."""
