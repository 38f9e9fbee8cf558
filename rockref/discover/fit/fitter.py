"""The one door of the fit: hypotheses are evaluated, refined and compared here.

1. A hypothesis is a set of effects with z, all its numbers in prior deviations.
2. Its runs listen to the records (`rockref.discover.listening`); the innovations are its residuals.
3. Wide central differences give the Jacobian, robust weights the Gauss-Newton matrix.
4. Six dampings are tried at once, and the best step is taken.
5. Stages of growing memory lead from a smooth objective to one that tells the most.
6. At the last one, differences along the directions of the posterior find the bottom of a valley, and its width.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rockref.api import Model
from rockref.discover.fit.differences import NARROWER, WIDEST, Residuals, jacobian
from rockref.discover.fit.directions import SOFTENED, Spread, moved, softened, spread_about, way, wider
from rockref.discover.fit.objective import inflation_for, loss, mean_loss, objective, weight
from rockref.discover.fit.problem import FitProblem
from rockref.discover.fit.stages import Stage
from rockref.discover.hypotheses.parameter import Parameter

#: Dampings of a Gauss-Newton step that are tried at once, and its longest component in prior deviations (decided).
DAMPINGS = (1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0)
LONGEST = 1.5
#: Steps that follow one, by slopes that learn from it (decided: with one, pairs on simulated blocks of other feet come
#: to the same loss in a tenth to a fifth less time; a second gains nothing more).
FOLLOWING = 1
#: Nats that a step must gain for another one to follow (decided: neighbouring valleys differ by more).
LEAST_GAIN = 3.0
#: Share of the objective that a step must gain for another one to follow far from the valley (decided: there steps gain
#: a half and more, and nats by the thousand say nothing).
SHARE = 0.02
#: Mean loss that inflated noise leaves, and the move [prior deviations] below which a tempered fit has arrived
#: (decided).
TEMPERED, SMALL_MOVE = 1.5, 0.02


@dataclass(eq=False)
class FittedModel:
    """A hypothesis at one z: its effects, innovations r (R, n, 3) of the last stage, objective [nat], mean loss.

    loss is that at the true noise, whatever the stage's inflation. start : z at the end of the first stage.
    H : Gauss-Newton matrix of the last refinement;  spread : the same along directions, of the last `polish`.
    """

    effects: tuple[str, ...]
    z: np.ndarray
    r: np.ndarray | None = field(default=None, repr=False)
    objective: float = np.inf
    loss: float = np.inf
    start: np.ndarray | None = field(default=None, repr=False)
    H: np.ndarray | None = field(default=None, repr=False)
    spread: Spread | None = field(default=None, repr=False)

    @property
    def name(self) -> str:
        """Return the effects in words."""
        return " + ".join(self.effects) or "the baseline"

    def copy(self) -> FittedModel:
        """Return a copy that a fit may move."""
        return replace(self, z=self.z.copy())


class Fitter:
    """Fits hypotheses of one problem, stage by stage."""

    def __init__(self, problem: FitProblem):
        self.problem = problem
        self._widths: dict[str, float] = {}

    def parameters(self, h: FittedModel) -> tuple[Parameter, ...]:
        """Return the numbers of a hypothesis."""
        return self.problem.parameters(h.effects)

    def model(self, h: FittedModel) -> Model:
        """Return the model of a hypothesis, released as in the first run."""
        model = self.problem.job(self.parameters(h), h.z, only=[0]).models[0]
        assert model is not None
        return model

    def residuals(self, stage: Stage) -> Residuals:
        """Return the innovations at a stage; widths of differences are kept from stage to stage."""
        return Residuals(self.problem, stage, self._widths)

    def widen(self) -> None:
        """Let the next differences be wider by one step, where they had to be narrow."""
        for name in list(self._widths):
            self._widths[name] = min(self._widths[name] / NARROWER, WIDEST)

    def evaluate(self, h: FittedModel, stage: Stage) -> FittedModel:
        """Set the innovations, objective and mean loss of a hypothesis at a stage."""
        self.evaluate_all([h], stage)
        return h

    def evaluate_all(self, field_: Sequence[FittedModel], stage: Stage) -> None:
        """Evaluate many hypotheses at once."""
        residuals = self.residuals(stage)
        jobs = [self.problem.job(self.parameters(h), h.z) for h in field_]
        fine = max(residuals.fineness(self.parameters(h), h.z) for h in field_)
        for h, r in zip(field_, residuals.of(jobs, fine), strict=True):
            self._set(h, r, residuals)

    def _set(self, h: FittedModel, r: np.ndarray, residuals: Residuals) -> None:
        h.r, h.objective = r, objective(r, h.z)
        h.loss = mean_loss(r * residuals.stage.inflation, residuals.count)

    def linearise(
        self, h: FittedModel, stage: Stage, absent: Sequence[Parameter] = ()
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return Gauss-Newton matrix (G, G) and gradient (G,) of the objective at h, with the prior.

        absent : numbers of effects that h does not have, which follow its own.
        """
        assert h.r is not None
        z = np.concatenate([self.pulled(h, stage), np.zeros(len(absent))])
        return normal_equations(self.slopes(h, stage, absent), h.r, z)

    def pulled(self, h: FittedModel, stage: Stage) -> np.ndarray:
        """Return z (G,) of h as its prior pulls it at a stage: not where a number is held."""
        held = [p.form and stage.holds_forms for p in self.parameters(h)]
        return np.where(held, 0.0, h.z)

    def slopes(self, h: FittedModel, stage: Stage, absent: Sequence[Parameter] = ()) -> np.ndarray:
        """Return the change of the innovations with each number of h, and of `absent` ones, (G, samples)."""
        assert h.r is not None
        parameters = (*self.parameters(h), *absent)
        z = np.concatenate([h.z, np.zeros(len(absent))])
        return jacobian(self.residuals(stage), parameters, z, h.r, len(absent)).reshape(len(z), -1)

    def descend(self, h: FittedModel, stage: Stage, J: np.ndarray, moves: np.ndarray | None = None) -> float:
        """Take a step by slopes J (G, samples), and more by what each tells of them; return what they gained [nat].

        moves : (G, G), the change of z along the directions of J, if these are not z itself
        """
        gained = 0.0
        for left in range(FOLLOWING, -1, -1):
            assert h.r is not None
            r, z = h.r, h.z
            H, g = normal_equations(J, r, self.pulled(h, stage), moves)
            gain = self.step(h, stage, H, g, moves)
            gained += max(gain, 0.0)
            if gain <= 0 or left == 0:
                break
            step = h.z - z if moves is None else np.linalg.solve(moves, way(self.parameters(h), z, h.z))
            J = learned(J, step, (h.r - r).ravel())
        return gained

    def step(
        self, h: FittedModel, stage: Stage, H: np.ndarray, g: np.ndarray, moves: np.ndarray | None = None
    ) -> float:
        """Take the best of six damped steps, if one is lower; return what it gained [nat].

        moves : (G, G), the change of z along the directions of H and g, if these are not z itself
        """
        parameters, residuals = self.parameters(h), self.residuals(stage)
        points = [damped(h.z, H, g, damping, parameters, moves) for damping in DAMPINGS]
        found = residuals.at(parameters, points)
        objectives = [objective(r, z) for r, z in zip(found, points, strict=True)]
        best = int(np.argmin(objectives))
        gain = h.objective - objectives[best]
        if gain > 0:
            h.z = points[best]
            self._set(h, found[best], residuals)
        return float(gain)

    def refine(self, h: FittedModel, stage: Stage, most: int) -> FittedModel:
        """Take at most so many Gauss-Newton steps at a stage."""
        self.evaluate(h, stage)
        for _ in range(most):
            J = self.slopes(h, stage)
            assert h.r is not None
            h.H, _ = normal_equations(J, h.r, h.z)
            if self.descend(h, stage, J) < LEAST_GAIN:
                break
        self.problem.refined(h, stage)
        return h

    def polish(self, h: FittedModel, stage: Stage, most: int) -> FittedModel:
        """Take at most so many Gauss-Newton steps along the directions of the posterior, and keep its spread.

        It goes on while a step gains, or the valley turns out wider than it was known to be.
        h : refined, so that its valley is known.
        """
        self.evaluate(h, stage)
        for _ in range(most):
            if not self.polished(h, stage):
                break
        self.problem.refined(h, stage)
        return h

    def polished(self, h: FittedModel, stage: Stage) -> bool:
        """Take one step of `polish` from h, evaluated at the stage; return whether another one may gain."""
        if h.spread is not None:
            known = h.spread.covariance(SOFTENED)
        else:
            known = softened(self.linearise(h, stage)[0] if h.H is None else h.H)
        assert h.r is not None
        h.spread = spread_about(self.residuals(stage), self.parameters(h), h.z, h.r, known)
        gain = self.descend(h, stage, h.spread.J.reshape(len(h.z), -1), h.spread.moves)
        return gain >= LEAST_GAIN or wider(h.spread.covariance(SOFTENED), known)

    def settle(self, h: FittedModel, stage: Stage, most: int) -> FittedModel:
        """Go on while a step gains more than SHARE of the objective."""
        for _ in range(most):
            before = h.objective
            self.refine(h, stage, 1)
            if h.objective > (1 - SHARE) * before:
                break
        return h

    def tempered(self, h: FittedModel, stage: Stage, most: int) -> FittedModel:
        """Take steps with the noise inflated to what is left, never rising.

        Far from the valley the weights of a robust loss would leave most innovations out; tempered, they count.
        """
        self.evaluate(h, stage)
        count, inflation = self.residuals(stage).count, np.inf
        for _ in range(most):
            assert h.r is not None
            true = h.r
            inflation = min(inflation, inflation_for(true, count, TEMPERED))
            before, warm = h.z, stage.inflated(inflation)
            self.widen()
            h.r, h.objective = true / inflation, objective(true / inflation, h.z)
            self.descend(h, warm, self.slopes(h, warm))
            h.r = h.r * inflation
            h.objective = objective(h.r, h.z)
            moved = float(np.abs(h.z - before).max())
            if moved < SMALL_MOVE and inflation == 1.0:
                break
            if moved == 0.0:
                inflation *= 0.7
        return h

    def without(self, h: FittedModel, effect: str) -> FittedModel:
        """Return the same point without one effect."""
        kept = [p.effect != effect for p in self.parameters(h)]
        H = h.H if h.spread is None else h.spread.matrix()
        less = None if H is None else H[np.ix_(kept, kept)]
        return FittedModel(tuple(e for e in h.effects if e != effect), h.z[kept].copy(), H=less)

    def with_effect(self, h: FittedModel, effect: str, z: np.ndarray | None = None) -> FittedModel:
        """Return the same point with one more effect, at z (its numbers), or absent."""
        more = len(self.problem.parameters((effect,))) - len(self.problem.parameters())
        return FittedModel((*h.effects, effect), np.concatenate([h.z, np.zeros(more) if z is None else z]))

    def losses(self, h: FittedModel) -> np.ndarray:
        """Return the mean loss by run and axis (R, 3) of the last stage, without smoothing."""
        assert h.r is not None
        n = self.problem.listener.valid[:, : h.r.shape[1]].sum(axis=1)
        return loss(h.r).sum(axis=1) / n[:, None]


def normal_equations(
    J: np.ndarray, r: np.ndarray, z: np.ndarray, moves: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return Gauss-Newton matrix (G, G) and gradient (G,) of the objective, with the prior, by slopes J (G, samples).

    moves : as in `Fitter.descend`
    """
    weighted, moves = J * weight(r.ravel()), np.eye(len(z)) if moves is None else moves
    return weighted @ J.T + moves.T @ moves, weighted @ r.ravel() + moves.T @ z


def learned(J: np.ndarray, step: np.ndarray, change: np.ndarray) -> np.ndarray:
    """Return slopes J (G, samples) with which a step (G,) gives the change (samples,) that it gave, else as they were.

    C. G. Broyden (1965), Math. Comput. 19:577-593, doi:10.1090/S0025-5718-1965-0198670-6.
    """
    return J + np.outer(step, change - step @ J) / (step @ step)


def damped(
    z: np.ndarray, H: np.ndarray, g: np.ndarray, damping: float, parameters: Sequence[Parameter],
    moves: np.ndarray | None = None,
) -> np.ndarray:  # fmt: skip
    """Return z after a damped Gauss-Newton step, no component longer than LONGEST, inside its limits."""
    d = -np.linalg.solve(H + damping * np.diag(np.diag(H)), g)
    return stepped(z, d if moves is None else moves @ d, parameters, moves is not None)


def stepped(z: np.ndarray, d: np.ndarray, parameters: Sequence[Parameter], along: bool = False) -> np.ndarray:
    """Return z moved by d, no component longer than LONGEST, inside its limits.

    along : whether d is one along directions of the posterior, to be bent as these are
    """
    reach = np.array([p.reach for p in parameters])
    d = d * min(1.0, LONGEST / max(float((np.abs(d) / reach).max()), 1e-300))
    if along:
        return moved(parameters, z, d)
    least, most = np.array([p.least for p in parameters]), np.array([p.most for p in parameters])
    return np.clip(z + d, least, most)
