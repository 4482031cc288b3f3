"""Report: a study as one page to be read, complete in one file."""

from pathloom.study.report.report import report as report
from pathloom.study.report.report import summarised as summarised
