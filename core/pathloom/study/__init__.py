"""Studies: what runs (design), who runs it (execute), what is kept (store), and what it says (statistics, report)."""

from pathloom.study.beginning import ablate, compare
from pathloom.study.carrying_out import carry_out
from pathloom.study.errors import StudyError
from pathloom.study.row import NAMES, Row, RunHistory, Status
from pathloom.study.session import Workers
from pathloom.study.study import Progress, Study

__all__ = [
    "NAMES",
    "Progress",
    "Row",
    "RunHistory",
    "Status",
    "Study",
    "StudyError",
    "Workers",
    "ablate",
    "carry_out",
    "compare",
]
