"""The animation: a GIF that Pillow reads, with the frames that it was given, or evenly fewer."""

import numpy as np
import pytest
from PIL import Image

from pathloom.draw import animate
from pathloom.errors import PathloomError


def frames(path, count: int) -> list:
    return [(n, [path, path[::2], path[:1]], path, 0.01 * n) for n in range(count)]


def test_every_generation_is_a_frame_and_the_last_one_stays(tmp_path, walls, scene) -> None:
    file = tmp_path / "a.gif"
    animate(frames(scene["path"], 5), file, occupied=walls, start=(9, 0), goal=(0, 9))
    with Image.open(file) as image:
        assert (image.format, image.n_frames) == ("GIF", 5)
        assert image.info["loop"] == 0
        durations = []
        for n in range(5):
            image.seek(n)
            durations.append(image.info["duration"])
    assert durations[-1] > 2 * max(durations[:-1])


def test_of_many_generations_at_most_120_are_drawn(tmp_path, scene) -> None:
    file = tmp_path / "a.gif"
    many = frames(np.array([(1, 0), (0, 9)]), 500)
    animate(iter(many), file, occupied=np.zeros((2, 10)), start=(1, 0), goal=(0, 9))
    with Image.open(file) as image:
        assert image.n_frames == 120


@pytest.mark.parametrize("shape", [(10, 10), (1, 1), (3, 200), (200, 3), (900, 1400)])
@pytest.mark.parametrize("dark", [False, True])
def test_any_size_of_map_becomes_a_picture_of_medium_size(tmp_path, shape, dark) -> None:
    rows, cols = shape
    file = tmp_path / "a.gif"
    path = np.array([(rows - 1, 0), (0, cols - 1)])
    animate(
        [(0, [path], path, None), (1, [], None, 0.5)], file, occupied=np.zeros(shape), closed=np.ones(shape),
        start=(rows - 1, 0), goal=(0, cols - 1), dark=dark,
    )  # fmt: skip
    with Image.open(file) as image:
        assert 380 <= max(image.size) <= 720
        assert image.n_frames == 2


def test_obstacles_crowd_and_best_are_seen_in_their_places(tmp_path, walls) -> None:
    from pathloom.draw.colours import LIGHT, rgb

    file = tmp_path / "a.gif"
    crowd, best = np.array([(9, 0), (9, 9)]), np.array([(0, 0), (0, 9)])
    animate([(0, [crowd] * 40, best, 1.0)], file, occupied=walls, start=(9, 0), goal=(0, 9))
    with Image.open(file) as image:
        pixels = np.asarray(image.convert("RGB"))
    side = (pixels.shape[1] - 24) // 10
    place = {name: (34 + side * r + side // 2, 12 + side * c + side // 2) for name, (r, c) in
             {"wall": (2, 3), "crowd": (9, 5), "best": (0, 5)}.items()}  # fmt: skip
    assert tuple(pixels[place["wall"]]) == rgb(LIGHT.wall)
    assert tuple(pixels[place["best"]]) == rgb(LIGHT.best)
    row, col = place["crowd"]
    assert rgb(LIGHT.crowd) in {tuple(pixel) for pixel in pixels[row - 2 : row + 3, col]}


def test_the_same_frames_give_the_same_bytes(tmp_path, walls, scene) -> None:
    for name in ("a.gif", "b.gif"):
        animate(frames(scene["path"], 3), tmp_path / name, occupied=walls, start=(9, 0), goal=(0, 9))
    assert (tmp_path / "a.gif").read_bytes() == (tmp_path / "b.gif").read_bytes()


@pytest.mark.parametrize(
    ("name", "count", "message"),
    [
        ("a.png", 1, r"found the suffix '\.png', allowed \.gif \.mp4"),
        ("a.gif", 0, r"found no frames"),
        ("none/a.gif", 1, r"no such folder"),
    ],
)
def test_what_cannot_be_written_is_refused_in_one_line(name, count, message, tmp_path, walls, scene) -> None:
    with pytest.raises(PathloomError, match=message) as error:
        animate(frames(scene["path"], count), tmp_path / name, occupied=walls, start=(9, 0), goal=(0, 9))
    assert "\n" not in str(error.value)
    assert not list(tmp_path.iterdir())
