"""Colours and dashes: the same on paper, on the page and in motion; told apart without colour too."""

#: Measured curves.
INK = "#1f2328"
#: One colour and one dash for every model, in the order of the models (Okabe and Ito 2008, safe for colour-blind eyes).
COLOURS = ("#d55e00", "#0072b2", "#009e73", "#cc79a7", "#8a6d00")
DASHES = ((6, 2), (2, 2), (9, 3, 2, 3), (12, 4), (1, 3))
#: Housner's model, noise floor and other lines to hold against.
GREY = "#6b7280"
HOUSNER_DASH = (5, 4)
#: Main impacts: vertical lines.
IMPACT = "#b42318"
FRAME, GRID = "#d1d9e0", "#e7ebef"
#: The band of noise and run-to-run spread.
BAND = "#c9d3de"
AXIS_NAMES = ("main (X)", "transverse (Y)", "longitudinal (Z)")


def colour(model: int) -> str:
    """Return the colour of the model at this place."""
    return COLOURS[model % len(COLOURS)]


def dash(model: int) -> tuple[int, ...]:
    """Return the dash of the model at this place, in pixels; a full line is the measured one."""
    return DASHES[model % len(DASHES)]
