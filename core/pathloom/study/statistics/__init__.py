"""Statistics of studies: what the runs show, and how sure that is.

scipy does what it has; here is what it lacks, and what goes with runs that fail.
"""

from pathloom.study.statistics.latex import latex as latex
from pathloom.study.statistics.runs import Runs as Runs
from pathloom.study.statistics.summary import Summary as Summary
from pathloom.study.statistics.summary import summary as summary
