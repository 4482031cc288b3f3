"""The closed loop: motions, drivers, and how drives end."""

import math

import numpy as np
import pytest

import pathloom as pl
from pathloom.local.actions import Action
from pathloom.local.drivers.avoiding import Avoiding
from pathloom.local.drivers.driver import View
from pathloom.local.drivers.dynamic_window import DynamicWindow
from pathloom.local.drivers.guarded import Guarded
from pathloom.local.drivers.pure_pursuit import PurePursuit
from pathloom.local.driving import points_along
from pathloom.local.hazards import Hazards
from pathloom.local.robot import Motion, Pose, Robot
from pathloom.local.rules import FourLeaves

ROOM = pl.load_map("empty-10")
PATH = np.array([(9, 0), (0, 9)])
FREE = pl.ClosedLoop(hazards=Hazards(standing=0, walking=0))
BUSY = pl.ClosedLoop(hazards=Hazards(standing=2, walking=1))


def test_a_pose_moves_on_a_circle_or_straight_on():
    assert Pose(1, 2, 0).after(Motion(0.5, 0.0), 2.0) == (2.0, 2.0, 0.0)
    quarter = Pose(0, 0, 0).after(Motion(1.0, 1.0), math.pi / 2)
    assert quarter == pytest.approx((1.0, 1.0, math.pi / 2))


def test_actions_turn_to_the_side_that_they_are_named_for():
    robot = Robot()
    assert robot.motion(Action.FORWARD).turn == 0.0
    assert robot.motion(Action.SLIGHT_LEFT).turn > 0.0 > robot.motion(Action.SLIGHT_RIGHT).turn
    assert robot.motion(Action.SHARP_RIGHT).turn < robot.motion(Action.SLIGHT_RIGHT).turn
    with pytest.raises(pl.ConfigError, match="allowed at most speed"):
        Robot(speed=0.2)


@pytest.mark.parametrize("driver", [PurePursuit(), Avoiding(), Guarded(), DynamicWindow()], ids=lambda d: d.name)
def test_in_an_empty_room_every_driver_arrives_by_the_path(driver):
    drive = FREE.drive(ROOM, PATH, driver, FourLeaves().decide, seed=1)
    assert drive.end == "reached"
    assert drive.length == pytest.approx(9 * math.sqrt(2), abs=0.06)
    assert drive.travelled == pytest.approx(drive.length, rel=0.1)


def test_the_guard_lets_a_robot_through_a_door():
    walls = np.zeros((9, 7), bool)
    walls[4] = True
    walls[4, 3] = False
    drive = FREE.drive(pl.OccupancyGrid(walls), [(7, 1), (5, 3), (3, 3), (1, 1)], Guarded(), FourLeaves().decide)
    assert drive.end == "reached"


def test_a_threat_is_what_a_motion_comes_too_near_to():
    readings = np.full(24, 5.0)
    readings[12], readings[18] = 0.6, 0.35  # ahead, and to the left
    view = View(Pose(0.0, 0.0, 0.0), readings, (1.0, 0.0), 1.0, Robot(), 5.0)
    assert view.threat(Motion(0.5, 0.0), 0.6, 0.1) == pytest.approx((0.6, 0.0))
    assert view.threat(Motion(0.5, 0.0), 0.2, 0.1) is None  # still far enough ahead, and no nearer to the left
    assert view.threat(Motion(0.0, 1.0), 0.6, 0.1) is None


def test_who_looks_for_nothing_drives_into_what_stands_in_the_way_and_who_looks_does_not():
    seeds = range(4)
    blind = [BUSY.drive(ROOM, PATH, PurePursuit(), seed=seed).end for seed in seeds]
    seeing = [BUSY.drive(ROOM, PATH, DynamicWindow(), seed=seed).end for seed in seeds]
    assert blind.count("collided") >= 3
    assert "collided" not in seeing


def test_a_drive_depends_on_its_seed_alone_and_all_meet_the_same_hazards():
    first, again, other = (
        BUSY.drive(ROOM, PATH, Guarded(), FourLeaves().decide, seed=seed, record=True) for seed in (5, 5, 6)
    )
    assert first == again != other
    rival = BUSY.drive(ROOM, PATH, PurePursuit(), seed=5, record=True)
    assert rival.frames[0].discs.tolist() == first.frames[0].discs.tolist()


def test_a_driver_that_asks_a_policy_says_so_when_there_is_none():
    with pytest.raises(pl.ConfigError, match="found no policy"):
        BUSY.drive(ROOM, PATH, Avoiding())


def test_a_path_that_leads_nowhere_or_begins_in_a_wall_is_refused():
    with pytest.raises(pl.ConfigError, match="allowed one that leads somewhere"):
        points_along([(1, 1), (1, 1)], 5, 1.0)
    cramped = pl.ClosedLoop(robot=Robot(radius=0.8))
    with pytest.raises(pl.ConfigError, match="room at the start"):
        cramped.drive(ROOM, PATH, PurePursuit())


def test_points_along_a_path_are_metres_with_y_upwards():
    points = points_along([(4, 0), (4, 2), (0, 2)], 5, 0.5)
    assert points[0].tolist() == [0.25, 0.25]
    assert points[-1].tolist() == pytest.approx([1.25, 2.25])
    assert np.hypot(*np.diff(points, axis=0).T).max() <= 0.05 + 1e-9
