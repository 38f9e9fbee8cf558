"""What a fit of tosses may reach must hold what the tosses show without a contact model."""

import numpy as np

from rockref.discover.tosses.descent import limits
from rockref.discover.tosses.parameters import effect_parameters


def test_hysteresis_can_make_nearly_all_of_the_loss_that_corners_show():
    """e^2 = 1/(1 + kappa): at the highest kappa a rebound of 0.28 needs no damper; the corners show 0.26 to 0.28."""
    kappa = effect_parameters("hysteretic_contact")
    (low,), (high,) = limits(kappa)
    assert kappa[0].value(low) == 0.0
    assert 1 / np.sqrt(1 + kappa[0].value(high)) < 0.28
