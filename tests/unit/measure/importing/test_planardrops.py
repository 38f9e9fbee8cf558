"""Planar drops of a square become an experiment of kind toss: axes, half turns, lost trackers, foreign folders."""

import numpy as np
import pytest

from rockref.measure.importing.planardrops import RATE, WIDTH, import_planardrops
from rockref.measure.tosses.load import load_tosses
from rockref.model.errors import InputError


def drop(angle, spin, jump=None):
    """A square that falls from a hand's height, turns, and lies still at last; columns of the source."""
    t = np.arange(60) / RATE
    theta = angle + spin * np.minimum(t, 0.1)
    half = 0.5 * WIDTH * (np.abs(np.cos(theta)) + np.abs(np.sin(theta)))
    z = np.maximum(0.06 - 0.5 * 9.81 * t**2, half)
    x = 0.3 - 0.5 * t
    if jump is not None:
        theta = np.where(t > 0.12, theta + jump, theta)
    zero = np.zeros(60)
    return np.column_stack([x, z, theta, zero, zero, zero])


def clone(folder, drops):
    folder.mkdir()
    for k, rows in enumerate(drops, start=1):
        text = "\n".join(",".join(f"{a:.9f}" for a in row) for row in rows)
        (folder / f"traj_{k}.csv").write_text("x,z,th,vx,vz,vth\n" + text + "\n")
    return folder


def test_poses_are_those_of_the_source_with_x_reversed_and_half_turns_gone(tmp_path):
    rows = [drop(0.2, 5.0), drop(0.2, 5.0, np.pi), drop(0.2, 5.0, 1.0)]
    assert import_planardrops(clone(tmp_path / "clone", rows), tmp_path / "out") == (2, 1)
    tosses = load_tosses(tmp_path / "out")
    assert (tosses.rate, tosses.width) == (pytest.approx(RATE), WIDTH) and [t.id for t in tosses.tosses] == ["1", "2"]
    one, other = tosses.tosses
    # Six digits of a metre, seven of a quaternion.
    assert np.abs(one.x[:, 0] + rows[0][:, 0]).max() < 1e-6 and np.abs(one.Lambda - other.Lambda).max() < 1e-6
    # Turned about +y: x of the body goes down where the angle grows.
    assert one.Lambda[0, 2, 0] == pytest.approx(-np.sin(0.2), abs=1e-6)
    assert import_planardrops(tmp_path / "clone", tmp_path / "out") == (2, 1)


def test_what_is_no_clone_and_what_belongs_to_others_is_refused(tmp_path):
    with pytest.raises(InputError, match="E-FOLDER"):
        import_planardrops(tmp_path, tmp_path / "out")
    source = clone(tmp_path / "clone", [drop(0.2, 5.0)])
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes.txt").write_text("mine")
    with pytest.raises(InputError, match="E-WRITE"):
        import_planardrops(source, tmp_path / "mine")
    (source / "traj_1.csv").write_text("x,z\n1,2\n")
    with pytest.raises(InputError, match="E-SHAPE"):
        import_planardrops(source, tmp_path / "out")
