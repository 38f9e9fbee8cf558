"use strict";
// The mystery: an effect and its size drawn by a seed, and records of a block that has it.
let secret = null;
const MYSTERY = {
  runs: [
    { id: "01", tilt: 0.117, turned: false, use: "fit" },
    { id: "02", tilt: 0.098, turned: false, use: "fit" },
    { id: "03", tilt: 0.117, turned: true, use: "fit" },
    { id: "04", tilt: 0.108, turned: false, use: "holdout" },
  ],
  duration: 2.5,
  gyro: { rate: 1000, bandwidth: 300, noise: 0.05, resolution: 0.01, range: null },
};

// Mulberry32: uniform numbers in [0, 1) from a whole seed. Source: T. Ettinger, public domain.
function uniform(seed) {
  let a = seed >>> 0;
  return () => {
    a = (a + 0x6d2b79f5) >>> 0;
    let t = Math.imul(a ^ (a >>> 15), a | 1);
    t = (t + Math.imul(t ^ (t >>> 7), t | 61)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

// Normal numbers by Box and Muller.
function normal(draw) {
  return () => Math.sqrt(-2 * Math.log(1 - draw())) * Math.cos(2 * Math.PI * draw());
}

// Numbers of a hidden effect: typical ones times a size of 0.7 to 1.6, with signs where both are physical.
function drawEffect(draw) {
  const ids = Object.keys(setup.hideable);
  const id = ids[Math.floor(draw() * ids.length)];
  const size = 0.7 + 0.9 * draw();
  const values = { ...setup.defaults[id] };
  for (const item of setup.hideable[id]) {
    const sign = item.positive || draw() < 0.5 ? 1 : -1;
    // Typical is a third of a prior deviation, or what the typical value itself says.
    values[item.name] = valueOf(item, sign * size * item.typical_z);
  }
  return { id, size, values };
}

function hide(q) {
  const draw = uniform(q.seed);
  const gauss = normal(draw);
  const effect = drawEffect(draw);
  const numbers = { ...setup.golden_models.table_3_1 };
  // The block is not quite that of Table 3.1: half a prior deviation of each parameter.
  for (const item of setup.shared) numbers[item.name] = valueOf(item, 0.5 * gauss());
  secret = { seed: q.seed, effect, numbers };
  const samples = MYSTERY.duration * MYSTERY.gyro.rate + 1;
  const runs = MYSTERY.runs.map((run) => {
    const made = engine.run({
      numbers,
      effects: { [effect.id]: effect.values },
      points: 8,
      rows: MYSTERY.duration * 4000 + 2,
      every: 25,
      step: 1e-5,
      theta: run.tilt + 5e-4 * gauss(),
      turned: run.turned,
      roll: 5e-5 * gauss(),
    });
    const rates = Float64Array.from(engine.recorded(made, MYSTERY.gyro, samples), (w) => {
      const shown = w * DEGREES + MYSTERY.gyro.noise * gauss();
      return Math.round(shown / MYSTERY.gyro.resolution) * MYSTERY.gyro.resolution;
    });
    return { ...run, step: 1 / MYSTERY.gyro.rate, rates };
  });
  return { name: "mystery " + q.seed, gyro: MYSTERY.gyro, tilt_uncertainty: 1.4e-3, runs };
}

function reveal() {
  return secret;
}
