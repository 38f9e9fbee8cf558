"""The model of a tossed body, and the way between measured poses and poses of its centre of mass over the plate."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rockref.api import Model
from rockref.effects.base import Effect
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.tracking.plate_pose import PlatePose
from rockref.effects.tracking.tag_frame import TagFrame
from rockref.measure.records.toss import Tosses
from rockref.measure.tosses.flight import Poses
from rockref.measure.tosses.load import CUBE_INERTIA, CUBE_MU, CUBE_RESTITUTION
from rockref.model.problem import ContactPoints
from rockref.model.rotation import exponential

#: Frames over which the direction of the throw is read; decided: 8 frames at 148 Hz are 60 mm of way.
THROW_FRAMES = 8
#: Depth to which the corner of the nominal model sinks at 1 m/s of normal speed [m]; decided: what the lowest nominal
#: corner is seen to dip below the plate's height in the public tosses, 4 mm, less the 1.2 mm by which their cube rests.
DIP = 3e-3


def nominal_model(tosses: Tosses) -> Model:
    """Return the plain law with stated values: a uniform box with a contact point at every corner.

    A restitution e of one corner fixes the damping ratio, beta = -ln e / sqrt(pi^2 + ln^2 e) (linear spring and
    damper); the stiffness follows from the dip, K = m_eff (1 m/s / dip)^2 with the effective mass of a corner of the
    falling cube. K_T = K_N and C_T = C_N: nothing is stated about the tangential direction.
    """
    m, w, h = tosses.mass, tosses.width, tosses.height
    cube = abs(w - h) < 1e-9 and abs(m - 0.37) < 1e-9 and abs(w - 0.1048) < 1e-9
    J = np.eye(3) * CUBE_INERTIA if cube else np.diag([m / 12 * (w * w + h * h)] * 2 + [m / 6 * w * w])
    effective = 1 / (1 / m + (w / 2) ** 2 / J[0, 0])  # of a corner struck along an edge direction of lever w/2
    log_e = np.log(CUBE_RESTITUTION)
    beta = float(-log_e / np.sqrt(np.pi**2 + log_e**2))
    K = float(effective * (1.0 / DIP) ** 2)
    return Model(
        mass=m, width=w, depth=w, height=h, inertia=J, points="custom",
        custom_points=corners(w, w, h, K, 2 * beta * float(np.sqrt(K * effective)), CUBE_MU),
        origin={"source": "stated values of the tosses; plain law"},
    )  # fmt: skip


def corners(width: float, depth: float, height: float, K: float, C: float, mu: float) -> ContactPoints:
    """Return eight equal contact points at the corners of a box about its centre."""
    signs = [(x, y, z) for z in (-1, 1) for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    P = np.array(signs) * np.array([width, depth, height]) / 2
    same = np.ones(8)
    return ContactPoints(
        P=P, K_N=K * same, K_T=K * same, C_N=C * same, C_T=C * same, mu_0=mu * same, mu=mu * same, radius=None,
        names=tuple(f"{i % 4 + 1}{'low' if i < 4 else 'high'}" for i in range(8)),
    )  # fmt: skip


def nominal_corners(model: Model) -> np.ndarray:
    """Return the contact points of the model without its effects, (n, 3) from the middle [m]."""
    return np.array(model.body_without_effects()[1].P)


def effect_of(model: Model, kind: type[Effect], **shapes: float):
    """Return the effect of this kind in a model, or one that is absent and has these shapes."""
    return next((effect for effect in model.effects if effect.id == kind.id), None) or kind(**shapes)


@dataclass(frozen=True)
class Frames:
    """How tracked poses lie to the body and the plate.

    heading : (B, 3, 3) board to throw frame;  plate : (3, 3) plate axes in the throw frame;  height [m]
    turn : (3, 3) body in tracked axes;  centre : (3,) centre of mass from the tracked point, body axes [m]
    """

    heading: np.ndarray
    plate: np.ndarray
    height: float
    turn: np.ndarray
    centre: np.ndarray

    @property
    def board_to_plate(self) -> np.ndarray:
        """Return (B, 1, 3, 3) turns."""
        return (self.plate.T @ self.heading)[:, None]

    @property
    def lift(self) -> np.ndarray:
        """Return origin of the plate from that of the board, plate axes (3,) [m]."""
        return self.plate.T @ np.array([0.0, 0.0, self.height])

    def to_body(self, x: np.ndarray, Lambda: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Turn tracked poses (B, F, ...) into those of the centre of mass over the plate."""
        A = self.board_to_plate
        Lambda = A @ Lambda @ self.turn
        return (A @ x[..., None])[..., 0] - self.lift + Lambda @ self.centre, Lambda

    def over_plate(self, poses: Poses) -> Poses:
        """Return tracked poses as those of the centre of mass over the plate."""
        x, Lambda = self.to_body(poses.x, poses.Lambda)
        return poses._replace(x=x, Lambda=Lambda)

    def to_tracked(self, x: np.ndarray, Lambda: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the way back."""
        A = self.board_to_plate.swapaxes(-1, -2)
        lifted = x - Lambda @ self.centre + self.lift
        return (A @ lifted[..., None])[..., 0], A @ Lambda @ self.turn.T


def cut(poses: Poses, frames: int) -> Poses:
    """Return the first frames of every toss."""
    n = min(frames, len(poses.t))
    return poses._replace(
        t=poses.t[:n], x=poses.x[:, :n], Lambda=poses.Lambda[:, :n], frames=np.minimum(poses.frames, n)
    )


def throw_frame(poses: Poses) -> np.ndarray:
    """Return (B, 3, 3) turns about e_z into the frame in which the block is thrown toward -x."""
    last = np.minimum(THROW_FRAMES, poses.frames) - 1
    way = poses.x[np.arange(len(last)), last] - poses.x[:, 0]
    size = np.hypot(way[:, 0], way[:, 1])
    c, s = np.where(size > 1e-4, (-way[:, :2] / np.maximum(size, 1e-4)[:, None]).T, [[1.0], [0.0]])
    H = np.zeros((len(last), 3, 3))
    H[:, 0, 0], H[:, 0, 1], H[:, 1, 0], H[:, 1, 1], H[:, 2, 2] = c, s, -s, c, 1
    return H


def frames_of(model: Model, heading: np.ndarray) -> Frames:
    """Return the frames that a model's tracking effects and eccentricity make."""
    tag, plate, mass = effect_of(model, TagFrame), effect_of(model, PlatePose), effect_of(model, MassEccentricity)
    slope = np.hypot(plate.slope_x, plate.slope_y)
    # The turn that takes e_z to the normal (-slope_x, -slope_y, 1), about e_z x normal.
    axis = np.array([plate.slope_y, -plate.slope_x, 0.0])
    tilt = exponential(axis / slope * np.arctan(slope)) if slope > 0 else np.eye(3)
    return Frames(
        heading=heading,
        plate=tilt,
        height=plate.height,
        turn=exponential(np.array([tag.turn_x, tag.turn_y, tag.turn_z])),
        centre=np.array([tag.x + mass.x, tag.y + mass.y, tag.z + mass.z]),
    )


def in_the_step(model: Model) -> Model:
    """Return the model without the effects of the tracking, which change no force."""
    return replace(model, effects=tuple(e for e in model.effects if e.question != "tracking"))
