"""Names and places of the numbers that the simulator of the blind test reads: globals of a run, columns of a point."""

from __future__ import annotations

#: What acts on a run as a whole. Everything is zero where nothing is hidden.
GLOBALS = (
    "gravity", "gravity_x", "gravity_y",
    # normal contact
    "hertz_p", "hertz_x0", "hertz_form", "crossley_a", "crossley_form", "hysteresis", "hysteresis_form",
    "pull", "pull_range", "pull_form",
    # friction
    "stribeck_excess", "stribeck_v", "stribeck_form", "load_p", "load_ref", "load_form", "viscous", "viscous_form",
    "spin", "spin_form", "roll", "roll_form", "normals_form",
    # loads
    "drag", "drag_form", "cable_k", "cable_c", "cable_form", "wire", "wire_tau", "wire_form",
    "shake", "shake_f", "shake_dir", "shake_phase", "shake_harmonic",
    "top", "bottom",
    # the plate: a mass on a spring, and its pitch
    "plate_m", "plate_f", "plate_ratio", "pitch_k", "pitch_J", "pitch_c",
    # things that are in no list
    "hung_m", "hung_kx", "hung_ky", "hung_kz", "hung_cx", "hung_cy", "hung_cz", "hung_z",
    "magnet", "magnet_y", "magnet_length", "gust", "gust_t", "gust_width", "gust_z", "gust_x",
    "rotor_x", "rotor_y", "rotor_z", "creep_k", "creep_tau",
    # where another form is equal to the catalogue's: load [N], depth [m], sliding speed [m/s], way of the top [m]
    "half_weight", "depth_0", "speed_0", "sway_0",
)  # fmt: skip
#: What belongs to a point: stiffness and damping, friction, and the slope of the plate where it stands.
POINT = ("K_N", "K_T", "C_N", "C_T", "mu", "radius", "slope_x", "slope_y")

G = {name: place for place, name in enumerate(GLOBALS)}
P = {name: place for place, name in enumerate(POINT)}
