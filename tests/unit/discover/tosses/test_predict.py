"""Frames, predictions and errors of tosses."""

import numpy as np
import pytest

from rockref.discover.tosses.body import frames_of, throw_frame
from rockref.discover.tosses.compare import compare, row_of
from rockref.discover.tosses.errors import angle, errors
from rockref.discover.tosses.predict import predict
from rockref.discover.tosses.stretches import STRETCHES, stretch_of
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.effects.loads.quadratic_drag import QuadraticDrag
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.rounded_corners import RoundedCorners
from rockref.effects.tracking.plate_pose import PlatePose
from rockref.effects.tracking.tag_frame import TagFrame
from rockref.measure.tosses.flight import side_by_side
from rockref.measure.tosses.load import load_tosses
from rockref.model.rotation import exponential
from tests.tosses import made, stated, write_tosses

EFFECTS = (
    MassEccentricity(0.001, -0.002, 0.006),
    PlateTilt(0.004, -0.003),
    TagFrame(4e-4, -3e-4, 2e-4, 0.003, -0.002, 0.004),
    PlatePose(1e-3, 4e-3, -6e-3),
)


def as_measured(model, folder, count=5, frames=80, seed=1):
    x, Lambda, _ = made(model, count, frames, seed)
    tosses = load_tosses(write_tosses(folder, x, Lambda))
    return tosses, side_by_side(tosses.tosses, tosses.rate)


def test_to_the_body_and_back():
    model = stated().replace(effects=EFFECTS)
    rng = np.random.default_rng(0)
    x, Lambda = rng.normal(size=(3, 7, 3)), exponential(rng.normal(size=(3, 7, 3)))
    heading = exponential(np.column_stack([np.zeros(3), np.zeros(3), rng.normal(size=3)]))
    frames = frames_of(model, heading)
    back = frames.to_tracked(*frames.to_body(x, Lambda))
    assert np.max(np.abs(back[0] - x)) < 1e-14
    assert np.max(np.abs(back[1] - Lambda)) < 1e-14


def test_a_point_of_the_sloping_plate_has_height_zero():
    frames = frames_of(stated().replace(effects=(PlatePose(2e-3, 0.01, -0.02),)), np.eye(3)[None])
    board = np.array([[[0.3, -0.2, 2e-3 + 0.01 * 0.3 + 0.02 * 0.2]]])
    x, _ = frames.to_body(board, np.eye(3)[None, None])
    assert abs(x[0, 0, 2]) < 1e-15


def test_the_throw_goes_to_minus_x(tmp_path):
    _, poses = as_measured(stated(), tmp_path / "t", frames=20)
    way = (throw_frame(poses) @ (poses.x[:, 7] - poses.x[:, 0])[..., None])[..., 0]
    assert np.all(way[:, 0] < 0)
    assert np.max(np.abs(way[:, 1])) < 1e-12


def test_the_true_model_predicts_its_own_tosses(tmp_path):
    model = stated().replace(effects=EFFECTS)
    tosses, poses = as_measured(model, tmp_path / "t")
    right = errors(predict(model, poses), poses, tosses.width)
    wrong = errors(predict(stated(), poses), poses, tosses.width)
    # Written digits (1e-7) grow over three impacts by some hundred; with 5 tosses none is near a choice of corners.
    assert np.max(right.position) < 2e-3
    assert np.median(wrong.position) > 10 * np.max(right.position)


def test_the_compiled_tosses_are_those_of_the_law(tmp_path):
    pytest.importorskip("numba")
    model = stated().replace(effects=(MassEccentricity(0, 0, 0.006), RoundedCorners(1e-3)))
    _, poses = as_measured(model, tmp_path / "t", count=2, frames=30)
    fast, slow = predict(model, poses), predict(model, poses, engine="numpy")
    assert np.array_equal(fast.x, slow.x)
    assert np.array_equal(fast.Lambda, slow.Lambda)


def test_the_angle_is_geodesic():
    for size in (1e-9, 1e-3, 1.0, 3.0, np.pi):
        assert angle(exponential(np.array([0, size, 0])), np.eye(3)) == pytest.approx(size, rel=1e-6)


def test_a_rounded_corner_touches_the_faces_from_inside():
    sharp, r = stated(), 2e-3
    points = sharp.replace(effects=(RoundedCorners(r),)).body()[1]
    centres = np.asarray(points.P) + [0, 0, r]
    faces = np.asarray(sharp.body()[1].P)
    assert np.max(np.abs(np.abs(faces) - np.abs(centres) - r)) < 1e-15


def test_stretches_come_in_their_order(tmp_path):
    _, poses = as_measured(stated(), tmp_path / "t", frames=130)
    found = stretch_of(poses, np.asarray(stated().body()[1].P))
    assert np.all(np.diff(found, axis=1) >= 0)
    assert np.all(found[:, 0] == 0) and np.all(found[:, -1] == STRETCHES.index("rest"))


def test_compare_says_both_starts_and_both_uses(tmp_path):
    tosses, _ = as_measured(stated(), tmp_path / "t", count=12, frames=60)
    record = compare(tosses).to_dict()
    assert {(r["use"], r["start"]) for r in record["rows"]} == {
        (u, s) for u in ("fit", "holdout") for s in ("flight", "raw")
    }
    for row in record["rows"]:
        if row["start"] == "flight":
            assert row["position_percent"]["median"] < 0.2


def test_where_a_toss_is_does_not_depend_on_the_model(tmp_path):
    x, Lambda, _ = made(stated(), 8, frames=60, seed=3)
    poses = side_by_side(load_tosses(write_tosses(tmp_path / "t", x, Lambda)).tosses, 148.0)
    other = stated().replace(effects=(RoundedCorners(radius=5e-3), MassEccentricity(0, 0, 5e-3)))
    rows = [row_of("m", model, poses, 0.1048, "fit", "flight").stretches for model in (stated(), other)]
    where = [[(s["stretch"], s["tosses"], s["frames_percent"]) for s in row] for row in rows]
    assert where[0] == where[1] and len(where[0]) > 3


class OwnDrag(QuadraticDrag):
    """Drag as a user would write it, under the name of the catalogue's."""


def test_an_effect_of_ones_own_is_left_to_the_law(tmp_path):
    """The compiled step knows those of the catalogue alone; the law moves the block in the same way."""
    pytest.importorskip("numba")
    _, poses = as_measured(stated(), tmp_path / "t", count=2, frames=12)
    own, catalogue_s, none = (
        predict(stated().replace(effects=effects), poses).Lambda
        for effects in ((OwnDrag(0.01),), (QuadraticDrag(0.01),), ())
    )
    assert np.abs(own - catalogue_s).max() < 1e-9 < 1e-6 < np.abs(own - none).max()
