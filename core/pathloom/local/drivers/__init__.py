"""Who steers: along a global path, around what the map does not show, or both, one a file."""
