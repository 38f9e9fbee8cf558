"""One force evaluation, compiled: rules K1 to A3 for all points, with the groups of effects that a variant has."""

from __future__ import annotations

from rockref.engines.compiled import columns as col
from rockref.engines.compiled import slots
from rockref.engines.compiled.contact import altered, altered_friction, by_share, oriented, returned, surely_held, trial
from rockref.engines.compiled.jit import inlined, marked
from rockref.engines.compiled.lanes import anyof, both, choose, negated
from rockref.engines.compiled.loads import add_loads, resistance
from rockref.engines.compiled.points import of_foot, pulled, pushed, roll_moment, spin_moment


def make_evaluation(groups: int, bearing: int):
    """Make the evaluation with these groups of effects; what belongs to the others is not compiled.

    bearing : whether it also sums normal forces and their lever arms, which the correction of a listening run needs.
    """
    contact, forces_too, moments_too = groups & slots.CONTACT, groups & slots.FORCES, groups & slots.MOMENTS
    loads, plate, shaken = groups & slots.LOADS, groups & slots.PLATE, groups & slots.SHAKEN

    def evaluate(
        body, centres, props, memory, forces, e, on, timed, shaking, sunk,
        x0, x1, x2, v0, v1, v2, L0, L1, L2, L3, L4, L5, L6, L7, L8, W0, W1, W2, turn,
    ):  # fmt: skip
        """Return acceleration (3), body moment (3), force and moment on the plate at one pose, sums over points.

        The sums are of the normal forces and of normal force times lever arm (4); forces and memories are written.
        shaking : acceleration of the plate (3);  sunk : its q, q_rate, pitch, pitch_rate.

        Points above the plate are passed over: their forces are zero, and adding zero changes no bit.
        """
        turn0, turn1, turn2 = turn
        q, q_rate, pitch, pitch_rate = sunk
        ox = L0 * W0 + L1 * W1 + L2 * W2
        oy = L3 * W0 + L4 * W1 + L5 * W2
        oz = L6 * W0 + L7 * W1 + L8 * W2
        Fx = Fy = Fz = Mx = My = Mz = turning = 0.0
        place0 = place1 = place2 = 0.0
        if loads:
            resisting = resistance(on, e, v0, v1, v2, ox, oy, oz)
        if forces_too:
            pull, viscous, slope = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0, 0.0)
        if moments_too:
            spin = roll_x = roll_y = 0.0
        for i in range(centres.shape[0]):
            Px, Py, Pz = centres[i, 0], centres[i, 1], centres[i, 2]
            rz = (L6 * Px + L7 * Py + L8 * Pz) - props[i, col.RADIUS]
            height = x2 + rz
            if plate:
                height = height - q - pitch * (x1 + (L3 * Px + L4 * Py + L5 * Pz))
            above = height > 0.0  # not touching; lost numbers count as touching, so that they show
            anchored = memory[i, col.ANCHORED] != 0.0
            if anyof(both(above, anchored)):
                memory[i, col.ANCHORED] = choose(above, 0.0, memory[i, col.ANCHORED])  # T5
                memory[i, col.SLIDING] = choose(above, 0.0, memory[i, col.SLIDING])
                for j in range(3):
                    forces[i, j] = choose(above, 0.0, forces[i, j])  # N2
                if contact:
                    memory[i, col.XI_LARGEST] = choose(above, 0.0, memory[i, col.XI_LARGEST])
                if moments_too:
                    for j in (col.YAW, col.ROLL_X, col.ROLL_Y):
                        memory[i, j] = choose(above, 0.0, memory[i, j])
            if not anyof(negated(above)):
                if forces_too:
                    if on.adhesion:
                        if anyof(height < e[slots.ADHESION + 2]):
                            rx, ry = L0 * Px + L1 * Py + L2 * Pz, L3 * Px + L4 * Py + L5 * Pz
                            pull = pulled(pull, e, height, rx, ry)
                continue
            rx = L0 * Px + L1 * Py + L2 * Pz
            ry = L3 * Px + L4 * Py + L5 * Pz
            vx = v0 + (oy * rz - oz * ry)  # K1
            vy = v1 + (oz * rx - ox * rz)
            vz = v2 + (ox * ry - oy * rx)
            if plate:
                vz = vz - q_rate - pitch_rate * (x1 + ry)
            mu_0, mu = props[i, col.MU_0], props[i, col.MU]
            fz = props[i, col.K_N] * -height + props[i, col.C_N] * -vz  # (3.5a)
            if contact:
                fz = altered(on, e, fz, -height, -vz, props, i, memory, above)
                if on.orientation:
                    fz = oriented(e, fz, -vz, props, i, rx, ry, rz)
            fz = choose(fz <= 0.0, 0.0, fz)  # N1
            ux, uy = x0 + rx, x1 + ry
            sx, sy, tx, ty, size = trial(ux, uy, vx, vy, props, memory, i, turn0, turn1)
            if contact:
                loose = negated(size <= surely_held(on, e, mu, fz))
                if anyof(both(loose, negated(above))):
                    other_0, other = altered_friction(on, e, mu_0, mu, vx, vy, fz)
                    mu_0, mu = choose(loose, other_0, mu_0), choose(loose, other, mu)
            fx, fy = returned(ux, uy, vx, vy, sx, sy, tx, ty, size, fz, mu_0, mu, props, memory, i, above)
            fx, fy, fz = choose(above, 0.0, fx), choose(above, 0.0, fy), choose(above, 0.0, fz)  # N2
            if bearing:
                way = body[col.ONSET] * -vz
                begins = both(-height < way, negated(above))
                if anyof(begins):
                    fx, fy, fz = by_share(begins, -height, way, fx, fy, fz)
            forces[i, 0], forces[i, 1], forces[i, 2] = fx, fy, fz
            Fx += fx
            Fy += fy
            Fz += fz
            if bearing:
                place0 += fz * rx
                place1 += fz * ry
                place2 += fz * rz
            if plate:
                turning += (x1 + ry) * fz
            Mx += ry * fz - rz * fy  # A2
            My += rz * fx - rx * fz
            Mz += rx * fy - ry * fx
            if forces_too:
                if on.adhesion:
                    pull = pulled(pull, e, height, rx, ry)
                if on.viscous:
                    c = -e[slots.VISCOUS + 1]
                    px, py = choose(above, 0.0, c * vx), choose(above, 0.0, c * vy)
                    viscous = pushed(viscous, px, py, rx, ry, rz)
                if on.normals:
                    foot, share = props[i, col.FOOT], e[slots.NORMALS + 9]
                    a, b = of_foot(e, slots.NORMALS + 1, foot), of_foot(e, slots.NORMALS + 2, foot)
                    a, b = a + share * ((L0 * a + L1 * b) - a), b + share * ((L3 * a + L4 * b) - b)
                    slope = pushed(slope, fz * a, fz * b, rx, ry, rz)
            if moments_too:
                if on.spin:
                    spin += choose(above, 0.0, spin_moment(e, props, memory, i, fz, vx, vy, oz, turn2, above))
                if on.rolling:
                    mx, my = roll_moment(e, props, memory, i, fz, ox, oy, turn0, turn1, above)
                    roll_x += choose(above, 0.0, mx)
                    roll_y += choose(above, 0.0, my)
        mass, g, carried = body[col.MASS], body[col.GRAVITY], Fz
        place = (Fz, place0, place1, place2)
        Fz -= mass * g  # A1
        if shaken and on.base:
            Fx -= mass * shaking[0]  # B1
            Fy -= mass * shaking[1]
            Fz -= mass * shaking[2]
        if forces_too:
            if on.adhesion:
                carried += pull[0]
                turning += pull[1] + x1 * pull[0]
                Fz += pull[0]
                Mx += pull[1]
                My += pull[2]
            if on.viscous:
                Fx += viscous[0]
                Fy += viscous[1]
                Mx += viscous[2]
                My += viscous[3]
                Mz += viscous[4]
            if on.normals:
                Fx += slope[0]
                Fy += slope[1]
                Mx += slope[2]
                My += slope[3]
                Mz += slope[4]
        if moments_too:
            if on.spin:
                Mz += spin
            if on.rolling:
                Mx += roll_x
                My += roll_y
        if loads:
            Fx, Fy, Fz, Mx, My, Mz = add_loads(
                on, e, (Fx, Fy, Fz, Mx, My, Mz), timed, resisting, mass, g, x0, x1, v0, v1, v2, L2, L5, L8, ox, oy, oz
            )
        Tx = L0 * Mx + L3 * My + L6 * Mz  # A3
        Ty = L1 * Mx + L4 * My + L7 * Mz
        Tz = L2 * Mx + L5 * My + L8 * Mz
        return Fx / mass, Fy / mass, Fz / mass, Tx, Ty, Tz, carried, turning, place

    return inlined(marked(evaluate, groups, bearing))
