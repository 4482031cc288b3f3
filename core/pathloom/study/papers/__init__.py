"""Papers: the ablations that the papers made, each in a file, and studies from files of that kind."""

from pathloom.study.papers.reading import names as names
from pathloom.study.papers.reading import read as read
