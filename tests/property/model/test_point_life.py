"""The life of a contact point: it touches, sticks, slips, sticks again, lifts, and touches anew."""

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from rockref.model import contact
from tests.strategies import between

K_N, C_N, K_T, C_T = 6e7, 2e4, 5e7, 1.8e4


class ContactPoint(RuleBasedStateMachine):
    """One point moved by hand, step by step, beside a plain account of what it must remember.

    The account knows only: where the anchor was born, that it dies with the contact, and that it stays while the point
    sticks. Forces and anchors are those of the law.
    """

    @initialize(mu=st.floats(0.1, 1.0), ratio=st.sampled_from([1.0, 1.3]))
    def begin(self, mu, ratio):
        self.mu, self.mu_0 = mu, mu * ratio
        self.u, self.xi = np.zeros(2), -1e-5
        self.s, self.anchored, self.sliding = np.full(2, np.nan), False, False  # a stale anchor must not be used
        self.F_N, self.F_T, self.born = 0.0, np.zeros(2), None
        self.evaluate(np.zeros(2), 0.0)

    def evaluate(self, v, xi_rate):
        """One force evaluation of the law at the present place."""
        one = np.ones(1)
        was_sliding, before = self.sliding, (self.s.copy(), self.anchored)
        F_N = contact.open_gap(self.xi * one, contact.kelvin_voigt(self.xi * one, xi_rate * one, K_N * one, C_N * one))
        s, touching = contact.touch(self.xi * one, self.u[None], self.s[None], np.array([self.anchored]))
        F_trial = contact.trial_force(self.u[None], s, v[None], K_T * one, C_T * one)
        size = contact.norm(F_trial)
        limit = contact.threshold(F_N, np.array([self.sliding]) & touching, self.mu_0 * one, self.mu * one)
        stick = contact.sticks(size, limit)
        F_T = contact.radial_return(F_trial, size, stick, self.mu * F_N)
        s = contact.move_anchor(F_T, self.u[None], s, v[None], stick, K_T * one, C_T * one)
        self.F_N, self.F_T, self.s = float(F_N[0]), F_T[0], s[0]
        self.anchored, self.sliding = bool(touching[0]), bool(touching[0] & ~stick[0])
        self.v, self.before, self.was_sliding, self.stuck = v, before, was_sliding, bool(stick[0])
        self.size, self.limit = float(size[0]), float(limit[0])

    # --- what may happen to a point

    @rule(depth=between(0, 2e-5), speed=between(-0.05, 0.3))
    def press(self, depth, speed):
        self.xi = depth
        self.evaluate(np.zeros(2), speed)

    @rule(gap=between(1e-9, 1e-3), speed=between(-0.3, 0.3))
    def lift(self, gap, speed):
        self.xi = -gap
        self.evaluate(np.zeros(2), speed)

    @rule(angle=between(-3.2, 3.2), distance=between(0, 2e-6), speed=between(0, 1e-3))
    def creep(self, angle, distance, speed):
        """A little: mostly it sticks."""
        way = np.array([np.cos(angle), np.sin(angle)])
        self.u = self.u + distance * way
        self.evaluate(speed * way, 0.0)

    @rule(angle=between(-3.2, 3.2), distance=between(1e-5, 1e-3), speed=between(0, 0.5))
    def shove(self, angle, distance, speed):
        """A lot: where it is pressed on it slides."""
        way = np.array([np.cos(angle), np.sin(angle)])
        self.u = self.u + distance * way
        self.evaluate(speed * way, 0.0)

    @rule()
    def rest(self):
        """Without motion the spring alone acts: where it carries the force of the slide, the point sticks again."""
        self.evaluate(np.zeros(2), 0.0)

    @precondition(lambda self: self.xi >= 0)
    @rule()
    def rest_until_it_sticks(self):
        """After a slide the anchor is where the spring and the damper of the slide gave mu F_N; at rest one step of
        sliding puts it where the spring alone does, and the next one sticks."""
        for _ in range(2):
            self.evaluate(np.zeros(2), 0.0)
        # the spring carries mu F_N to the rounding of positions of 1e-3 m
        assert not self.sliding or self.size <= self.mu * self.F_N + K_T * 1e-18 * 1e3

    # --- what always holds

    @invariant()
    def pushes_or_is_away(self):
        assert self.F_N >= 0
        assert self.xi >= 0 or self.F_N == 0

    @invariant()
    def stays_in_the_cone(self):
        size = np.hypot(*self.F_T)
        assert size <= self.mu_0 * self.F_N * (1 + 1e-15)
        assert not self.sliding or abs(size - self.mu * self.F_N) <= 1e-15 * self.mu * self.F_N

    @invariant()
    def in_the_air_it_forgets(self):
        if self.xi < 0:
            assert not self.anchored
            assert not self.sliding
            assert np.all(self.F_T == 0)

    @invariant()
    def touches_where_it_is(self):
        """Born in this evaluation and sticking: the anchor is the place itself, and only the damper acts."""
        if self.anchored and not self.before[1] and not self.sliding:
            assert np.array_equal(self.s, self.u)
            assert np.array_equal(self.F_T, -C_T * self.v)

    @invariant()
    def an_anchor_that_holds_does_not_move(self):
        if self.anchored and self.before[1] and not self.sliding:
            assert np.array_equal(self.s, self.before[0])

    @invariant()
    def an_anchor_that_slides_follows(self):
        """It ends where spring and damper give the friction force: within (mu F_N + C |v|) / K of the point."""
        if self.sliding:
            reach = (self.mu * self.F_N + C_T * np.hypot(*self.v)) / K_T
            assert np.hypot(*(self.u - self.s)) <= reach * (1 + 1e-9) + 1e-17

    @invariant()
    def sticks_up_to_the_threshold_of_what_it_did(self):
        """T6: the static threshold for a point that was not sliding, the dynamic one for one that was."""
        if self.anchored:
            mu = self.mu if self.was_sliding else self.mu_0
            assert self.limit == mu * self.F_N
            assert self.stuck == (self.size <= self.limit)


TestContactPoint = ContactPoint.TestCase
TestContactPoint.settings = settings(stateful_step_count=30)
