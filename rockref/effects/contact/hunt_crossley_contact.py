"""A damper that grows with depth."""

from dataclasses import dataclass

from rockref.effects.base import Effect, Quantity


@dataclass(frozen=True)
class HuntCrossleyContact(Effect):
    """Adds a K_N xi xi_rate to spring and damper, before the no-tension cut.

    Simplified: Hunt and Crossley have it in place of the linear damper and with the power of the spring; here it is an
    addition, with the linear spring's K_N xi.
    """

    id = "hunt_crossley_contact"
    question = "contact"
    quantities = {"a": Quantity("s/m", 0.0, 0.02, 5.0, 0.5, "+", "damping per stiffness and depth", 0.0)}
    sentence = "Material damping acts in the area that touches, so it grows with depth and begins at zero."
    equation = r"F^{(N)} = \max\!\left(K^{(N)}\xi\,(1 + a\,\dot\xi) + C^{(N)}\dot\xi,\ 0\right)"
    source = "K. H. Hunt, F. R. E. Crossley (1975), J. Appl. Mech. 42:440-445, doi:10.1115/1.3423596"
    confounder = "hertzian_contact"
    experiment = "Releases from 0.02 to 0.13 rad: the loss at an impact grows faster than with the square of its speed."

    a: float = 0.0

    def normal_force(self, F, k, points, m):
        if self.is_absent():
            return F
        return F + self.a * points.K_N * k.xi * k.xi_rate
