import numpy as np
import pytest


@pytest.fixture
def walls() -> np.ndarray:
    walls = np.zeros((10, 10), bool)
    walls[2, 1:7] = walls[6, 3:10] = True
    return walls


@pytest.fixture
def scene() -> dict:
    """Ends and paths on that map, and a made-up history."""
    path = np.array([(9, 0), (7, 2), (4, 3), (3, 7), (0, 9)])
    return {
        "start": (9, 0),
        "goal": (0, 9),
        "path": path,
        "unrefined": np.insert(path, 1, (8, 0), axis=0),
        "optimum": path[[0, 1, 3, 4]],
        "history": {
            "evaluations": [10, 20, 30],
            "best": [0.1, 0.2, 0.2],
            "generation_best": [0.1, 0.2, 0.15],
            "mean": [0.05, None, 0.1],
            "diversity": [1.0, 0.5, 0.2],
        },
        "title": "a $map_$ with a sign of mathematics",
        "caption": "made up",
    }
