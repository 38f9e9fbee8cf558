"""The law as a backend that shows all its pieces: in any precision, with any rule replaced, one run or a batch."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.rule_set import Made, Rows, Rules
from rockref.conformance.vectors.claim import with_effect
from rockref.effects import catalogue
from rockref.engines import run
from rockref.model import integrator, parameters
from rockref.model.integrator import prepared_inertia
from rockref.model.problem import Block, ContactPoints, Problem, State, as_arrays, stack
from rockref.model.rotation import exp_minus_identity


class RulesBackend:
    """A backend made of `Rules`; every piece of the protocol is shown. Arguments and results: docs, "Judge your
    backend"."""

    language = "Python"

    def __init__(self, rules: Rules | None = None, dtype: Any = np.float64, name: str = "rules"):
        self.rules = rule_set.law() if rules is None else rules
        self.dtype = np.dtype(dtype)
        self.name = name
        self.precision = {4: "float32", 8: "float64"}.get(self.dtype.itemsize, "longdouble")

    def _array(self, a: Any, shape: tuple[int, ...] | None = None) -> np.ndarray:
        a = np.asarray(a)
        a = a if a.dtype == bool else a.astype(self.dtype)
        return a if shape is None else a.reshape(shape)

    def derived(self, **p: Any) -> dict[str, Any]:
        """Apply G1, G2, P1 to P3."""
        q = {k: self._array(v) for k, v in p.items()}
        P = self.rules.points(q["width"], q["depth"], q["height"], q["delta_long"], q["delta_diag"])
        external = np.arange(8) < 4
        K = {k: self.rules.stiffness(q[k], 8) for k in ("K_N", "K_T")}
        beta_N, beta_T = self.rules.damping_ratio(np.where(external, q["beta_ext"], q["beta_int"]))
        mu = np.where(external, q["mu_ext"], q["mu_int"])
        C_N, C_T = self.rules.damping(beta_N, K["K_N"], q["mass"]), self.rules.damping(beta_T, K["K_T"], q["mass"])
        J = self.rules.inertia(q["mass"], q["width"], q["depth"], q["height"])
        return {"inertia": J, "P": P, **K, "C_N": C_N, "C_T": C_T, "mu_0": mu, "mu": mu}

    def release(self, mass, g, P, K_N, theta_0) -> dict[str, Any]:
        """Return the release posture."""
        P = self._array(P)
        n = len(P)
        unused = np.zeros(n, self.dtype)
        points = ContactPoints(P, self._array(K_N), *(unused,) * 5, None, ("",) * n)
        block = Block(self._array(mass), np.eye(3, dtype=self.dtype), self._array(g))
        state = self.rules.release(block, points, self.dtype.type(theta_0))
        return {"x": state.x, "Lambda": state.Lambda}

    def kinematics(self, x, Lambda, v, W, P) -> dict[str, Any]:
        """Apply K1."""
        k = self.rules.kinematics(*(self._array(a) for a in (x, Lambda, v, W, P)))
        return {"r": k.r, "u": k.u, "xi": k.xi, "xi_rate": k.xi_rate, "v_slide": k.v_slide}

    def contact_law(
        self, xi, xi_rate, u_t, v_slide, s, anchored, sliding, K_N, C_N, K_T, C_T, mu_0, mu
    ) -> dict[str, Any]:
        """Apply N1, N2, T1 to T6 for one point."""
        one = [self._array(a, (1,)) for a in (xi, xi_rate)] + [self._array(a, (1, 2)) for a in (u_t, v_slide, s)]
        flags = [np.array([bool(a)]) for a in (anchored, sliding)]
        p = Made(*(self._array(a, (1,)) for a in (K_N, C_N, K_T, C_T, mu_0, mu)))
        with np.errstate(all="ignore"):
            c = self.rules.point_law(self.rules, *one, *flags, p)
        trace = {"s_trial": c.s_trial[0], "F_trial": c.F_trial[0], "threshold": c.threshold[0]}
        return {k: getattr(c, k)[0] for k in ("F_N", "F_T", "s", "touching", "sliding")} | {"trace": trace}

    def assemble(self, Lambda, r, F, mass, g) -> dict[str, Any]:
        """Apply A1 to A3."""
        Lambda, r, F, mass, g = (self._array(a) for a in (Lambda, r, F, mass, g))
        moment = self.rules.moment(r, F)
        return {"force": self.rules.force(F, mass, g), "moment": moment, "T": self.rules.body_moment(Lambda, moment)}

    def rotate(self, Theta) -> dict[str, Any]:
        """Return the exponential of I3."""
        return {"Lambda": self.rules.exponential(self._array(Theta)) + np.eye(3, dtype=self.dtype)}

    def integrate(self, x, v, Lambda, W, a, T, a_next, T_next, h, inertia) -> dict[str, Any]:
        """Apply I1 to I5 with prescribed accelerations and moments."""
        x, v, Lambda, W, a, T, a_next, T_next, h = (
            self._array(b) for b in (x, v, Lambda, W, a, T, a_next, T_next, self.dtype.type(h))
        )
        h = self.dtype.type(h)
        prepared = prepared_inertia(Block(self.dtype.type(1), self._array(inertia), self.dtype.type(0)))
        state = replace(State.at_rest(x, Lambda, 0, v, W), a=a, T=T)
        x_n, Theta, L_n, v_p, W_p, E, JW = self.rules.first_half(self.rules, state, prepared, h)
        v_n = self.rules.velocity(v, a, a_next, h)
        W_n = integrator.update_rates(W, JW, self.rules.momentum(JW, T, T_next, E, h), prepared.J_inverse)
        return {"x": x_n, "Theta": Theta, "Lambda": L_n, "v_predicted": v_p, "W_predicted": W_p, "v": v_n, "W": W_n}

    def step(self, problem: Problem) -> dict[str, Any]:
        """Return one full step from a state that brings a, T and F."""
        problem = as_arrays(problem, self.dtype)
        state = self._step(problem, self.rules.start(self.rules, problem))
        return {k: getattr(state, k) for k in STATE}

    def _step(self, problem: Problem, state: State) -> State:
        with np.errstate(all="ignore"):
            return self.rules.step(self.rules, problem, state, prepared_inertia(problem.block))

    def channel(self, W, Lambda) -> dict[str, Any]:
        """Apply M1 on a history."""
        return {"crv_deg_s": self.rules.channel(self._array(W), self._array(Lambda))}

    def simulate(self, problem: Problem) -> Any:
        """Return a run."""
        return rule_set.simulate(self.rules, problem, self.dtype)

    def simulate_many(self, problems: list[Problem]) -> list[Any]:
        """Return runs side by side as one batch."""
        rows: Rows = rule_set.simulate(self.rules, stack(problems), self.dtype)
        return [rows.pick(i) for i in range(len(problems))]


STATE = ("x", "v", "Lambda", "W", "s", "anchored", "sliding", "a", "T", "F")


def claimed(problem: Problem, effect: str, parameters: dict[str, Any]) -> Problem:
    """Return the problem with an effect by name."""
    return with_effect(problem, catalogue.make(catalogue.find(effect), parameters, "effect"))


class NumpyEngine(RulesBackend):
    """The law itself: `rockref.model` as users run it, with the pieces that its functions make up."""

    def __init__(self, dtype: Any = np.float64):
        super().__init__(rule_set.law(), dtype, name="rockref numpy")

    def derived(self, **p: Any) -> dict[str, Any]:
        """Apply G1, G2 by the rules; P1 to P3 as the model puts them together."""
        q = {k: np.asarray(v, float) for k, v in p.items()}
        names = ("K_N", "K_T", "beta_int", "beta_ext", "mu_int", "mu_ext")
        twelve = parameters.Parameters().replace(**{k: float(q[k]) for k in names})
        made = parameters.point_properties(twelve, float(q["mass"]), np.arange(8) < 4)
        return super().derived(**p) | made

    def rotate(self, Theta) -> dict[str, Any]:
        """Return the exponential of the model."""
        return {"Lambda": exp_minus_identity(self._array(Theta)) + np.eye(3, dtype=self.dtype)}

    def _step(self, problem: Problem, state: State) -> State:
        state = replace(state, memory=())
        with np.errstate(all="ignore"):
            return integrator.step(problem, state, prepared_inertia(problem.block))

    def simulate(self, problem: Problem) -> Any:
        """Return a run of the engine."""
        return run(problem, engine="numpy", dtype=self.dtype)

    def effect(self, problem: Problem, effect: str, parameters: dict[str, Any]) -> Any:
        """Return a run with an effect of the catalogue."""
        return run(claimed(problem, effect, parameters), engine="numpy", dtype=self.dtype)

    def shaken(self, problem: Problem) -> Any:
        """Return a run on a plate that moves."""
        return run(problem, engine="numpy", dtype=self.dtype)

    def sensor(self, effect: str, parameters: dict[str, Any], t: Any, crv_deg_s: Any) -> dict[str, Any]:
        """Return what the gyroscope makes of rates."""
        of = (catalogue.make(catalogue.find(effect), parameters, "effect"),)
        return {"crv_deg_s": np.degrees(catalogue.measured(of, np.asarray(t), np.radians(crv_deg_s)))}

    def simulate_many(self, problems: list[Problem]) -> list[Any]:
        """Return a batch of the engine."""
        response = run(stack(problems), engine="numpy", dtype=self.dtype)
        return [response[i] for i in range(len(problems))]


class NumbaEngine:
    """The compiled engine: whole runs, and one step as a run of one step."""

    language = "Python, compiled by numba"
    precision = "float64"
    name = "rockref numba"

    def simulate(self, problem: Problem) -> Any:
        """Return a run of the engine."""
        return run(problem, engine="numba")

    def effect(self, problem: Problem, effect: str, parameters: dict[str, Any]) -> Any:
        """Return a run with an effect of the catalogue."""
        return run(claimed(problem, effect, parameters), engine="numba")

    def shaken(self, problem: Problem) -> Any:
        """Return a run on a plate that moves."""
        return run(problem, engine="numba")

    def step(self, problem: Problem) -> dict[str, Any]:
        """Return one step: a run that long, from a state that brings a, T and F."""
        state = run(replace(problem, duration=problem.step, output_rate=1 / problem.step), engine="numba").final_state
        return {k: getattr(state, k) for k in STATE}
