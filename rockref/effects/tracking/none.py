"""The drawing's answer."""

from dataclasses import dataclass

from rockref.effects.base import Effect


@dataclass(frozen=True)
class TrackedAsDrawn(Effect):
    """The tracked frame is that of the body, and the plate is the board's plane z = 0."""

    question = "tracking"
    sentence = "Tags sit where the drawing has them, the plate lies in the plane of the camera's board."
    equation = r"\Lambda = \Lambda_t,\quad x = x_t,\quad z_p = 0"
    source = "Decided: what the poses of a recording mean until something else is shown"
