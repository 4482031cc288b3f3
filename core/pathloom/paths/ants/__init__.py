"""Ants on a grid: pheromone, what draws them, and the colony."""
