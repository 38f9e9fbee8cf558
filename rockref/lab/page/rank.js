"use strict";
// Which effect would help? One shared Gauss-Newton step of everything, for all effects from one Jacobian; the best are
// then evaluated.
const LOOKED_AT = 8;
// Sizes, in typical ones, at which an effect is looked at that shows nothing while it is small.
const SEEDS = [0.35, 0.6, 0.9, 1.3, 1.9];

// What a quadratic model of the objective gains by the step of some of the numbers.
function promised(H, b, of) {
  const d = stepOf(H, b, 1e-3, of);
  let gain = 0;
  of.forEach((i, p) => {
    gain -= b[i] * d[p];
    of.forEach((j, q) => {
      gain -= 0.5 * d[p] * H[i][j] * d[q];
    });
  });
  return gain;
}

// The same for an effect at a finite size: its residuals, and one step of all else.
function seeded(problem, items, z, J, extra, stage) {
  let best = null;
  for (const size of SEEDS) {
    const w = [...z, ...extra.map((_, k) => (k === 0 ? size / 3 : 0))];
    const r = residuals(problem, [...items, ...extra], w, stage);
    const { H, b } = normalEquations(J, r, z);
    const d = stepOf(H, b, 1e-3);
    const moved = w.map((v, i) => v + (i < d.length ? d[i] : 0));
    const o = objective(residuals(problem, [...items, ...extra], moved, stage), moved);
    if (!best || o < best.objective) best = { objective: o, z: moved };
  }
  return best;
}

function rank(problem, say) {
  const items = problem.items;
  const stage = STAGES.slice(0, 2);
  const z = items.map((item) => item.z);
  const r = residuals(problem, items, z, stage);
  const before = objective(r, z);
  const n = items.length;
  const J = items.map((_, i) => difference(problem, items, z, r, stage, i, 2.5 * before));
  const all = [...J];
  const places = {};
  const seeds = {};
  const candidates = Object.entries(problem.candidates);
  candidates.forEach(([id, extra], k) => {
    say({ share: k / candidates.length, id });
    if (extra[0].seeded) {
      seeds[id] = seeded(problem, items, z, J, extra, stage);
      return;
    }
    const wide = [...items, ...extra];
    const w = [...z, ...extra.map(() => 0)];
    places[id] = [...z.keys(), ...extra.map((_, j) => all.length + j)];
    extra.forEach((_, j) => all.push(difference(problem, wide, w, r, stage, n + j, 1.5 * before)));
  });
  const { H, b } = normalEquations(all, r, [...z, ...new Float64Array(all.length - n)]);
  const plain = lineSearch(problem, items, z, H, b, stage, [...z.keys()]);
  const order = Object.keys(places).sort((a, c) => promised(H, b, places[c]) - promised(H, b, places[a]));
  const found = order.slice(0, LOOKED_AT).map((id) => {
    const wide = [...items, ...problem.candidates[id]];
    return {
      id,
      ...lineSearch(problem, wide, [...z, ...problem.candidates[id].map(() => 0)], H, b, stage, places[id]),
    };
  });
  for (const [id, best] of Object.entries(seeds)) found.push({ id, ...best });
  found.sort((a, c) => a.objective - c.objective);
  const rows = found.map((f) => ({
    id: f.id,
    objective: f.objective,
    model: modelAt(problem, [...items, ...problem.candidates[f.id]], f.z),
  }));
  return { before, plain: plain.objective, samples: r.length, rows };
}
