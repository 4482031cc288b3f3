"""Maps: those printed in the papers, and families that are generated."""

from pathloom import Add, hookimpl


@hookimpl
def register(add: Add) -> None:
    """Add the maps."""
    from pathloom_maps.families import Blocks, Empty, Maze, RandomCells, Rooms
    from pathloom_maps.printed import IgaMap1, ImagaFig1

    for component in (IgaMap1, ImagaFig1, RandomCells, Blocks, Rooms, Maze, Empty):
        add(component)
