"""How the typical size of a hidden effect follows from the block.

An effect of the laboratory acts on a block of another size as it acts on the source's where it takes the same share of
what moves the block. So each typical size has a factor: a product of ratios to the source's block, all of them one for
that block itself. What belongs to the sensor, or is a share or an angle between surfaces already, has none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rockref.blind.simulator.world import SOURCE, TABLE, Block

#: What another form of an effect is equal to the catalogue's at: slots of the simulator, and the factor that each has.
REFERENCES = {"half_weight": "load", "depth_0": "depth", "speed_0": "speed", "sway_0": "sway"}


@dataclass(frozen=True)
class Scale:
    """Ratios of a block's natural units to those of the source's block; gravity is the same for both.

    mass : of the block, and with it its weight `load`. width, height, radius : base, block, half diagonal.
    angle : the critical tilt alpha. rate : p = sqrt(3 g / 4 R), the rate of rocking. contact : sqrt(K_N / m).
    """

    mass: float = 1.0
    width: float = 1.0
    height: float = 1.0
    radius: float = 1.0
    angle: float = 1.0
    rate: float = 1.0
    contact: float = 1.0

    @property
    def load(self) -> float:
        """Return weight."""
        return self.mass

    @property
    def spin(self) -> float:
        """Return angular rate of a swing, p alpha."""
        return self.rate * self.angle

    @property
    def speed(self) -> float:
        """Return speed of a foot at a main impact, width p alpha."""
        return self.width * self.spin

    @property
    def depth(self) -> float:
        """Return penetration at a main impact: that speed over the contact's frequency."""
        return self.speed / self.contact

    @property
    def sway(self) -> float:
        """Return way of the top in a swing, height alpha."""
        return self.height * self.angle

    @property
    def moment(self) -> float:
        """Return restoring moment of the weight, m g R alpha."""
        return self.mass * self.radius * self.angle


def scale_of(block: Block, parameters: dict[str, float]) -> Scale:
    """Return the ratios of a block, its stiffness K_N [N/m] among the parameters, to the source's."""
    own, source = _units(block, parameters["K_N"]), _units(SOURCE, TABLE["K_N"])
    return Scale(*(a / b for a, b in zip(own, source, strict=True)))


def _units(block: Block, K_N: float) -> tuple[float, ...]:
    radius = 0.5 * math.hypot(block.width, block.height)
    angle = math.atan2(block.width, block.height)
    return block.mass, block.width, block.height, radius, angle, radius**-0.5, math.sqrt(K_N / block.mass)


def factors(s: Scale) -> dict[str, float]:
    """Return the factor on the typical size by `effect.parameter`; what is missing has the factor one."""
    return _contact(s) | _shape(s) | _loads(s) | _unlisted(s)


def _contact(s: Scale) -> dict[str, float]:
    return {
        # Hertz' law meets the linear one at the depth of an impact: there the exponent alone tells them apart.
        "hertzian_contact.reference": s.depth,
        # A damper a K xi stands beside the law's own in the ratio of a times the speed of the impact.
        "hunt_crossley_contact.a": 1.0 / s.speed,
        # A pull is felt as a share of the weight. Its reach is the film's or the glue's, not the block's.
        "adhesion.force": s.load,
        # A film takes, at the speed of a foot, the same share of the weight. Stribeck's velocity is the surfaces' own.
        "viscous_friction.c": s.load / s.speed,
        "load_dependent_friction.reference": s.load,
        # Levers of the feet: moments of the weight over them, beside that of the weight over half the base.
        "spin_friction.radius": s.width,
        "rolling_resistance.lever": s.width,
        "creeping_feet.stiffness": s.mass * s.contact**2,
    }


def _shape(s: Scale) -> dict[str, float]:
    return {
        "rounded_feet.radius": s.width,
        # Slopes push the feet aside by a share of the weight, half the height below the centre: beside alpha.
        "uneven_contact_normals": s.angle,
        # Across the block against the width of its base, along it against its height.
        "mass_eccentricity.x": s.width,
        "mass_eccentricity.y": s.width,
        "mass_eccentricity.z": s.height,
        "mass_eccentricity.lump": s.mass,
    }


def _loads(s: Scale) -> dict[str, float]:
    return {
        # A moment c omega^2, a share of m g R alpha at the rate p alpha: the same part of the energy a swing.
        "quadratic_drag.c": s.moment / s.spin**2,
        # At the top: stiffness times sway times height, a share of m g R alpha; the damper acts at the rate p.
        "cable_restraint.k": s.moment / (s.sway * s.height),
        "cable_restraint.c": s.moment / (s.sway * s.height * s.rate),
        "lingering_wire_pull.force": s.moment / s.height,
        "lingering_wire_pull.tau": 1.0 / s.rate,
        # An acceleration beside g alpha. Its frequency is the floor's.
        "base_vibration.amplitude": s.angle,
        "plate_tilt": s.angle,
        # A plate as heavy beside the block, that yields as much beside the contacts.
        "compliant_support.mass": s.mass,
        "compliant_support.frequency": s.contact,
        "compliant_support.pitch": s.width,
        "release_velocity": s.spin,
        "release_velocity.height": s.width,
    }


def _unlisted(s: Scale) -> dict[str, float]:
    return {
        "hung.mass": s.mass,
        "hung.height": s.height,
        "hung.frequency": s.rate,
        "magnet.force": s.moment / s.height,
        "magnet.length": s.sway,
        "gust.force": s.moment / s.height,
        # A blow at a share of the height gives a share of the angular momentum about the base, m R^2 p alpha.
        "knock.impulse": s.mass * s.radius**2 * s.spin / s.height,
        # When something happens, counted in swings.
        "gust.time": 1.0 / s.rate,
        "gust.height": s.height,
        # A wheel turns the block by h p alpha, a share of m g R alpha.
        "rotor.angular_momentum": s.moment / s.spin,
    }
