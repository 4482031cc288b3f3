"""Saving a figure: the format by the suffix, the same bytes for the same figure, errors in one line."""

import pytest

from pathloom.draw import path_figure, save
from pathloom.errors import PathloomError

SIGNATURES = {".png": b"\x89PNG", ".svg": b"<?xml", ".pdf": b"%PDF"}


@pytest.mark.parametrize("suffix", SIGNATURES)
def test_the_same_figure_gives_the_same_bytes(suffix, tmp_path, walls, scene) -> None:
    first, again, anew = (tmp_path / f"{name}{suffix}" for name in ("first", "again", "anew"))
    figure = path_figure(walls, **scene)
    save(figure, first)
    save(figure, again)
    save(path_figure(walls, **scene), str(anew))
    assert first.read_bytes().startswith(SIGNATURES[suffix])
    assert first.read_bytes() == again.read_bytes() == anew.read_bytes()


def test_a_suffix_in_capitals_is_as_good(tmp_path, walls, scene) -> None:
    save(path_figure(walls, **scene), tmp_path / "A.PNG")
    assert (tmp_path / "A.PNG").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(("name", "found"), [("a.jpg", "suffix '.jpg'"), ("a", "no suffix")])
def test_another_suffix_is_refused_in_one_line(name, found, tmp_path, walls, scene) -> None:
    with pytest.raises(PathloomError, match=rf"found .*{found}, allowed \.png \.svg \.pdf") as error:
        save(path_figure(walls, **scene), tmp_path / name)
    assert "\n" not in str(error.value)
    assert not list(tmp_path.iterdir())


def test_a_missing_folder_is_refused_in_one_line(tmp_path, walls, scene) -> None:
    with pytest.raises(PathloomError, match=r"no such folder") as error:
        save(path_figure(walls, **scene), tmp_path / "none" / "a.svg")
    assert "\n" not in str(error.value)


def test_a_file_is_replaced_and_nothing_else_stays_behind(tmp_path, walls, scene) -> None:
    file = tmp_path / "a.svg"
    file.write_text("old")
    save(path_figure(walls, **scene), file)
    assert file.read_bytes().startswith(b"<?xml")
    assert list(tmp_path.iterdir()) == [file]
