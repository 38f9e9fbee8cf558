"""What is measured."""

import numpy as np

#: Degrees per radian.
DEGREES = 180.0 / np.pi


def crv_deg_s(W: np.ndarray) -> np.ndarray:
    """Rule M1: the measured channel, crv in deg/s about X (main), Y (transverse), Z (longitudinal).

    W : (..., 3) convected rotational velocity [rad/s], body axes  ->  (..., 3) [deg/s]. Source: Fig. 3.4.
    """
    return W * W.dtype.type(DEGREES)
