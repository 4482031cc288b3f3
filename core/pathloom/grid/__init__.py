"""Occupancy grids: the map itself, what its obstacles block, and the files that hold maps."""

from pathloom.grid.connectivity import labels
from pathloom.grid.covering import full_cell_cover
from pathloom.grid.inflation import inflate
from pathloom.grid.occupancy import OccupancyGrid
from pathloom.grid.reading import read_map
from pathloom.grid.scenario import Case, Scenario, read_scenario
from pathloom.grid.writing import write_map

__all__ = [
    "Case",
    "OccupancyGrid",
    "Scenario",
    "full_cell_cover",
    "inflate",
    "labels",
    "read_map",
    "read_scenario",
    "write_map",
]
