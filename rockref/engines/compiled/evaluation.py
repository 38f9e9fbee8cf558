"""One force evaluation, compiled: rules K1 to A3 for all points, with or without effects."""

from __future__ import annotations

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.contact import altered, altered_friction, friction
from rockref.engines.compiled.jit import inlined
from rockref.engines.compiled.loads import add_loads


def _make_evaluation(with_effects: bool):
    @inlined
    def evaluate(
        body, centres, props, memory, forces, e, t, q, q_rate,
        x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, turn0, turn1, turn2,
    ):  # fmt: skip
        """Acceleration (3) and body moment (3) at one pose; forces and memories of the points are written.

        Points above the plate are passed over: their forces are zero, and adding zero changes no bit.
        """
        ox = L0 * W0 + L1 * W1 + L2 * W2
        oy = L3 * W0 + L4 * W1 + L5 * W2
        oz = L6 * W0 + L7 * W1 + L8 * W2
        Fx = Fy = Fz = Mx = My = Mz = 0.0
        for i in range(centres.shape[0]):
            Px, Py, Pz = centres[i, 0], centres[i, 1], centres[i, 2]
            rz = (L6 * Px + L7 * Py + L8 * Pz) - props[i, col.RADIUS]
            height = x2 + rz
            if with_effects:
                height = height - q
            if height > 0.0:  # not touching; lost numbers count as touching, so that they show
                if memory[i, col.ANCHORED] != 0.0:
                    memory[i, col.ANCHORED] = memory[i, col.SLIDING] = 0.0  # T5
                    forces[i, 0] = forces[i, 1] = forces[i, 2] = 0.0  # N2
                if with_effects:
                    memory[i, col.XI_LARGEST] = 0.0
                    if e[slots.ADHESION] == 0.0:
                        continue
                    memory[i, col.XI], memory[i, col.R_Z] = -height, rz
                    memory[i, col.R_X], memory[i, col.R_Y] = L0 * Px + L1 * Py + L2 * Pz, L3 * Px + L4 * Py + L5 * Pz
                continue
            rx = L0 * Px + L1 * Py + L2 * Pz
            ry = L3 * Px + L4 * Py + L5 * Pz
            vx = v0 + (oy * rz - oz * ry)  # K1
            vy = v1 + (oz * rx - ox * rz)
            vz = v2 + (ox * ry - oy * rx)
            mu_0, mu = props[i, col.MU_0], props[i, col.MU]
            if with_effects:
                vz = vz - q_rate
            fz = props[i, col.K_N] * -height + props[i, col.C_N] * -vz  # (3.5a)
            if with_effects:
                fz = altered(fz, -height, -vz, props, i, e, memory)
            fz = 0.0 if fz <= 0.0 else fz  # N1
            if with_effects:
                mu_0, mu = altered_friction(mu_0, mu, vx, vy, fz, e)
                memory[i, col.XI], memory[i, col.R_X], memory[i, col.R_Y], memory[i, col.R_Z] = -height, rx, ry, rz
                memory[i, col.V_X], memory[i, col.V_Y] = vx, vy
            fx, fy = friction(x0 + rx, x1 + ry, vx, vy, fz, mu_0, mu, props, memory, i, turn0, turn1)
            forces[i, 0], forces[i, 1], forces[i, 2] = fx, fy, fz
            Fx += fx
            Fy += fy
            Fz += fz
            Mx += ry * fz - rz * fy  # A2
            My += rz * fx - rx * fz
            Mz += rx * fy - ry * fx
        mass = body[col.MASS]
        Fz -= mass * body[col.GRAVITY]  # A1
        if with_effects:
            if e[slots.ON_BODY] != 0.0:
                Fx, Fy, Fz, Mx, My, Mz = add_loads(
                    (Fx, Fy, Fz, Mx, My, Mz), e, mass, body[col.GRAVITY], props, memory, forces,
                    x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz, turn0, turn1, turn2, t,
                )  # fmt: skip
        Tx = L0 * Mx + L3 * My + L6 * Mz  # A3
        Ty = L1 * Mx + L4 * My + L7 * Mz
        Tz = L2 * Mx + L5 * My + L8 * Mz
        return Fx / mass, Fy / mass, Fz / mass, Tx, Ty, Tz

    return evaluate


evaluate_law = _make_evaluation(False)
evaluate_with_effects = _make_evaluation(True)
