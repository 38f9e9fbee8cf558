"use strict";
// Gauss-Newton with wide differences over runs that listen to the record; everything in prior deviations z.
const CAUCHY = 5;
const DAMPINGS = [1e-4, 1e-3, 1e-2, 1e-1, 1, 10];
// Width of a difference in prior deviations: it sees across the roughness that impacts give the objective.
const WIDEST = 0.25;
// No step is longer, in prior deviations.
const LONGEST = 1.5;
// Memories of rates and attitude [s], means over residuals [samples], timing error [s], steps in a tick of 0.5 ms.
// The release alone comes first: what the sensor does to the swing before any impact would lead the contacts astray.
const RELEASE = {
  name: "release",
  rates: 0.04,
  attitude: 1,
  smoothing: 2,
  jitter: 0,
  steps: 8,
  iterations: 2,
  early: true,
};
const STAGES = [
  RELEASE,
  { name: "memory 5 ms", rates: 0.005, attitude: 0.1, smoothing: 8, jitter: 0, steps: 8, iterations: 3 },
  { name: "memory 10 ms", rates: 0.01, attitude: 0.2, smoothing: 2, jitter: 0, steps: 16, iterations: 3 },
  { name: "memory 20 ms", rates: 0.02, attitude: 0.5, smoothing: 1, jitter: 5e-5, steps: 16, iterations: 2 },
];
// A stage ends when a step takes less than this share of the objective.
const LEAST_GAIN = 0.003;

const MAPS = {
  linear: (item, z) => item.centre + item.spread * z,
  log: (item, z) => item.centre * Math.exp(item.spread * z),
  // Absent at infinity: the inverse is what moves.
  inverse: (item, z) => (z > 1e-6 ? item.typical / (3 * z) : Infinity),
  // A plate's compliance: (typical frequency / frequency)^2; rigid at zero.
  compliance: (item, z) => (z > 3e-4 ? item.typical / Math.sqrt(3 * z) : 0),
};

function valueOf(item, z) {
  const value = MAPS[item.map](item, item.positive ? Math.max(z, 0) : z);
  return Math.min(Math.max(value, item.least), item.most);
}

// The model at z: numbers, effects, and the releases of the runs.
function modelAt(problem, items, z) {
  const numbers = { ...problem.numbers };
  const effects = {};
  for (const [id, values] of Object.entries(problem.effects)) effects[id] = { ...values };
  const releases = problem.runs.map((run) => ({ tilt: run.offset.tilt, roll: run.offset.roll }));
  items.forEach((item, k) => {
    const value = valueOf(item, z[k]);
    if (item.kind === "parameter") numbers[item.name] = value;
    else if (item.kind === "release") releases[item.run][item.name] = value;
    else {
      if (!effects[item.effect]) effects[item.effect] = { ...setup.defaults[item.effect] };
      effects[item.effect][item.name] = value;
    }
  });
  for (const id of Object.keys(effects)) if (isAbsent(id, effects[id])) delete effects[id];
  return { numbers, effects, releases };
}

function isAbsent(id, values) {
  return setup.switches[id].every(([name, absent]) => values[name] === absent);
}

// Whitened innovations of all runs in a stage, or in several, one after the other.
function residuals(problem, items, z, stages) {
  const model = modelAt(problem, items, z);
  const row = engine.modelRow(model.numbers);
  const values = engine.valueRow(model.effects);
  const parts = [].concat(stages).flatMap((stage) =>
    problem.runs.map((run, k) =>
      engine.innovations({
        id: k,
        row,
        values,
        gyro: problem.gyro,
        stage: { ...stage, steps: Math.ceil(stage.steps * (problem.finer || 1)) },
        record: run.record,
        samples: stage.early ? run.early : run.samples,
        sigma: run.sigma,
        turned: run.turned,
        theta: run.tilt + model.releases[k].tilt,
        roll: model.releases[k].roll,
      }),
    ),
  );
  const all = new Float64Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

function objective(r, z) {
  let sum = 0;
  for (let i = 0; i < r.length; i++) sum += Math.log1p((r[i] * r[i]) / (CAUCHY * CAUCHY));
  return ((CAUCHY * CAUCHY) / 2) * sum + 0.5 * z.reduce((s, v) => s + v * v, 0);
}

// Mean robust loss of a residual; white noise gives 0.945.
const meanLoss = (r) => (2 * objective(r, [])) / r.length;

// One column of the Jacobian: by differences as wide as the objective bears.
function difference(problem, items, z, r, stage, k, worst) {
  for (let width = WIDEST; ; width /= 4) {
    const moved = (by) => {
      const w = z.slice();
      w[k] += by;
      return w;
    };
    const up = moved(width);
    const above = residuals(problem, items, up, stage);
    let most = objective(above, up);
    const column = new Float64Array(r.length);
    if (items[k].positive && z[k] < width) {
      for (let i = 0; i < r.length; i++) column[i] = (above[i] - r[i]) / width;
    } else {
      const down = moved(-width);
      const below = residuals(problem, items, down, stage);
      most = Math.max(most, objective(below, down));
      for (let i = 0; i < r.length; i++) column[i] = (above[i] - below[i]) / (2 * width);
    }
    if (most <= worst || width < 0.02) return column;
  }
}

// Gauss-Newton matrix and gradient with the prior, of robust residuals.
function normalEquations(J, r, z) {
  const n = J.length;
  const H = Array.from({ length: n }, () => new Float64Array(n));
  const b = new Float64Array(n);
  const weight = Float64Array.from(r, (v) => 1 / (1 + (v / CAUCHY) ** 2));
  for (let a = 0; a < n; a++) {
    for (let c = 0; c <= a; c++) {
      let sum = 0;
      for (let i = 0; i < r.length; i++) sum += weight[i] * J[a][i] * J[c][i];
      H[a][c] = H[c][a] = sum;
    }
    let sum = 0;
    for (let i = 0; i < r.length; i++) sum += weight[i] * J[a][i] * r[i];
    H[a][a] += 1;
    b[a] = sum + z[a];
  }
  return { H, b };
}

// Solution of a positive definite system by Cholesky's method.
function solve(H, b) {
  const n = b.length;
  const L = Array.from({ length: n }, () => new Float64Array(n));
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = H[i][j];
      for (let k = 0; k < j; k++) sum -= L[i][k] * L[j][k];
      L[i][j] = i === j ? Math.sqrt(Math.max(sum, 1e-12)) : sum / L[j][j];
    }
  }
  const x = Float64Array.from(b);
  for (let i = 0; i < n; i++) {
    for (let k = 0; k < i; k++) x[i] -= L[i][k] * x[k];
    x[i] /= L[i][i];
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let k = i + 1; k < n; k++) x[i] -= L[k][i] * x[k];
    x[i] /= L[i][i];
  }
  return x;
}

// The step of these equations at a damping, cut to the longest.
function stepOf(H, b, damping, of) {
  const at = of || b.map((_, i) => i);
  const A = Array.from(at, (i) => Float64Array.from(at, (j) => H[i][j] * (i === j ? 1 + damping : 1)));
  const d = solve(
    A,
    Float64Array.from(at, (i) => -b[i]),
  );
  const size = Math.max(...d.map(Math.abs));
  return size > LONGEST ? d.map((v) => (v * LONGEST) / size) : d;
}

// The best of six dampings: z, residuals, objective.
function lineSearch(problem, items, z, H, b, stage, of) {
  let best = { objective: Infinity };
  for (const damping of DAMPINGS) {
    const d = stepOf(H, b, damping, of);
    const w = z.map((v, i) => v + d[i]);
    const r = residuals(problem, items, w, stage);
    const o = objective(r, w);
    if (o < best.objective) best = { z: w, r, objective: o };
  }
  return best;
}

function fit(problem, say) {
  const items = problem.items;
  let z = items.map((item) => item.z);
  let loss = 0;
  for (const stage of problem.stages || STAGES) {
    let r = residuals(problem, items, z, stage);
    let o = objective(r, z);
    loss = meanLoss(r);
    say({ stage: stage.name, step: 0, loss, model: modelAt(problem, items, z) });
    for (let k = 1; k <= stage.iterations; k++) {
      const J = items.map((_, i) => difference(problem, items, z, r, stage, i, 2.5 * o));
      const { H, b } = normalEquations(J, r, z);
      const best = lineSearch(problem, items, z, H, b, stage);
      if (!(best.objective < o)) break;
      const gain = o - best.objective;
      ({ z, r } = best);
      o = best.objective;
      loss = meanLoss(r);
      say({ stage: stage.name, step: k, loss, model: modelAt(problem, items, z) });
      if (gain < LEAST_GAIN * o) break;
    }
  }
  return { loss, model: modelAt(problem, items, z) };
}
