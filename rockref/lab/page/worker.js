"use strict";
// What the worker is asked: a run, the badge, a fit, a ranking, a hidden effect. One question at a time.
const FRAME_RATE = 500;
const DEGREES = 180 / Math.PI;
let engine = null;
let setup = null;

// Angles of Lambda = Rx(tilt) Ry(roll) Rz(turn).
function anglesOf(L, at) {
  return [
    Math.atan2(-L[at + 5], L[at + 8]),
    Math.asin(Math.min(1, Math.max(-1, L[at + 2]))),
    Math.atan2(-L[at + 1], L[at]),
  ];
}

function frames(made, points) {
  const C = engine.C;
  const every = Math.round(1 / (FRAME_RATE * made.fine));
  const count = Math.floor((made.written - 1) / every) + 1;
  const states = engine.floats(made.states, made.written * C.STATE);
  const forces = engine.floats(made.forces, made.written * points * 3);
  const angles = new Float32Array(3 * count);
  const loads = new Float32Array(points * count);
  for (let k = 0; k < count; k++) {
    angles.set(anglesOf(states, k * every * C.STATE + C.L), 3 * k);
    // Contacts are shorter than a frame: the largest load since the last one is shown.
    for (let row = Math.max(0, (k - 1) * every + 1); row <= k * every; row++) {
      for (let i = 0; i < points; i++)
        loads[points * k + i] = Math.max(loads[points * k + i], forces[3 * (points * row + i) + 2]);
    }
  }
  return { angles, loads, frames: count };
}

// For each point the instants at which it begins and ends to carry load, one after the other.
function contacts(made, points) {
  const forces = engine.floats(made.forces, made.written * points * 3);
  const found = [];
  for (let i = 0; i < points; i++) {
    const edges = [];
    let on = false;
    for (let row = 0; row < made.written; row++) {
      const now = forces[3 * (points * row + i) + 2] > 0;
      if (now !== on) edges.push(row * made.fine);
      on = now;
    }
    if (on) edges.push(made.written * made.fine);
    found.push(new Float32Array(edges));
  }
  return found;
}

function answerRun(q) {
  const began = performance.now();
  const points = q.numbers.points === 4 && !q.effects.foot_defects ? 4 : 8;
  const rows = Math.max(2, Math.ceil(q.end / (q.step * q.every)) + 2);
  const made = engine.run({ ...q, points, rows });
  if (made.written < 2) return { lost: true };
  const seen = Math.min(q.samples, Math.floor((made.written - 1) * made.fine * q.gyro.rate + 1e-6) + 1);
  const rates = Float64Array.from(engine.recorded(made, q.gyro, seen), (w) => w * DEGREES);
  const elapsed = performance.now() - began;
  return {
    rates,
    points,
    contacts: contacts(made, points),
    ...frames(made, points),
    lost: made.written < rows,
    elapsed,
    steps: (made.written - 1) * q.every,
  };
}

// The golden runs, computed here, against the digests of the NumPy text.
function answerBadge() {
  let steps = 0;
  const every = Math.round(1 / (setup.golden.output_rate * setup.golden.step));
  const began = performance.now();
  const runs = setup.golden.runs.map((run) => {
    const numbers = setup.golden_models[run.model];
    const rows = Math.round(run.duration * setup.golden.output_rate) + 1;
    const made = engine.run({
      numbers,
      effects: {},
      points: 8,
      rows,
      every,
      theta: numbers.theta_0,
      turned: run.turned,
      roll: run.out_of_plane,
      step: setup.golden.step,
    });
    steps += (rows - 1) * every;
    const found = engine.digest(made);
    return { title: run.title, found, same: found === run.sha256 };
  });
  return { runs, steps, elapsed: performance.now() - began };
}

const ANSWERS = {
  run: answerRun,
  badge: answerBadge,
  fit: (q, say) => fit(q, say),
  rank: (q, say) => rank(q, say),
  hide: (q) => hide(q),
  reveal: () => reveal(),
};

self.onmessage = (event) => {
  const q = event.data;
  if (q.kind === "setup") {
    setup = q;
    engine = makeEngine(q.wasm, q.layout);
    self.postMessage({ id: q.id, done: true });
    return;
  }
  const say = (news) => self.postMessage({ id: q.id, news });
  try {
    self.postMessage({ id: q.id, done: true, answer: ANSWERS[q.kind](q, say) });
  } catch (error) {
    self.postMessage({ id: q.id, done: true, failure: String(error) });
  }
};
