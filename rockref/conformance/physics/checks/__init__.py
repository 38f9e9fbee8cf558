"""The thirteen checks: twelve with a verdict or a remark here, a file a group, and the restitution passport."""

from collections.abc import Callable

from rockref.conformance.physics.checks import balancing, free_motion, resting, rocking, sliding, steps
from rockref.conformance.physics.finding import Finding
from rockref.conformance.physics.trial import Trial

#: Name of a check and its function, in the order in which a user should mend what they find.
CHECKS: dict[str, Callable[[Trial], Finding]] = {
    "echo": free_motion.echo,
    "flight": free_motion.flight,
    "fall": free_motion.fall,
    "rest": resting.rest,
    "slope": resting.slope,
    "slide": sliding.slide,
    "rocking period": rocking.period,
    "apex energy": rocking.energy,
    "impact ratio": rocking.ratio,
    "toppling": balancing.toppling,
    "balance on an edge": balancing.balance,
    "symmetry": steps.symmetry,
    "half step": steps.half_step,
}
