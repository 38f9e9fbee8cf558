"use strict";
// Records: packed columns of the page, noise and main impacts of a record, error by stretch and axis.
const AXES = ["main", "transverse", "longitudinal"];
const STRETCHES = [
  ["before", "before the first main impact"],
  ["between", "between the first two"],
  ["after", "after the second"],
];

// A packed column: base64 of 16-bit counts of `unit`, or of float64 where the unit is zero.
function unpack(column) {
  const raw = Uint8Array.from(atob(column.data), (c) => c.charCodeAt(0));
  if (column.unit === 0) return new Float64Array(raw.buffer);
  return Float64Array.from(new Int16Array(raw.buffer), (v) => v * column.unit);
}

function median(values) {
  const sorted = Float64Array.from(values).sort();
  return sorted.length ? sorted[sorted.length >> 1] : 0;
}

// Standard deviation of a sample about smooth motion: from third differences, whose squares sum to 20, by their median.
function noiseOf(x, least) {
  const third = [];
  for (let i = 3; i < x.length; i++) third.push(Math.abs(x[i] - 3 * x[i - 1] + 3 * x[i - 2] - x[i - 3]));
  return Math.max(median(third) / 0.6745 / Math.sqrt(20), least);
}

function runningMean(x, half) {
  const sums = new Float64Array(x.length + 1);
  for (let i = 0; i < x.length; i++) sums[i + 1] = sums[i] + x[i];
  return x.map((_, i) => {
    const a = Math.max(0, i - half);
    const b = Math.min(x.length, i + half + 1);
    return (sums[b] - sums[a]) / (b - a);
  });
}

// Main impacts [s]: the steepest drop of the main rate within 12 ms after its largest value in each swing.
function impactsOf(x, step) {
  const smooth = runningMean(x, Math.max(1, Math.round(0.0045 / step)));
  const fine = runningMean(x, Math.max(1, Math.round(0.001 / step)));
  const least = 0.05 * smooth.reduce((m, v) => Math.max(m, Math.abs(v)), 0);
  const reach = Math.round(0.012 / step);
  const gap = Math.max(1, Math.round(0.002 / step));
  const found = [];
  let sign = 0;
  let peak = -1;
  const close = () => {
    if (peak < 0) return;
    let drop = 0;
    let at = -1;
    for (let i = Math.max(gap, peak - reach); i < Math.min(x.length - gap, peak + reach); i++) {
      const fall = sign * (fine[i - gap] - fine[i + gap]);
      if (fall > drop) {
        drop = fall;
        at = i;
      }
    }
    if (at > 0 && peak < x.length - reach) found.push(at * step);
  };
  for (let i = 0; i < x.length; i++) {
    if (Math.abs(smooth[i]) <= least) continue;
    if (Math.sign(smooth[i]) !== sign) {
      close();
      sign = Math.sign(smooth[i]);
      peak = i;
    }
    if (Math.abs(smooth[i]) > Math.abs(smooth[peak])) peak = i;
  }
  return found;
}

// A run as the page keeps it: rates as three columns [deg/s], time from the release.
function prepareRun(run, gyro) {
  const columns = run.rates.map ? run.rates : [0, 1, 2];
  const axes = Array.isArray(run.rates)
    ? columns.map(unpack)
    : [0, 1, 2].map((k) => run.rates.filter((_, i) => i % 3 === k));
  const samples = axes[0].length;
  const t = Float64Array.from({ length: samples }, (_, i) => i * run.step);
  const least = gyro.resolution / Math.sqrt(12);
  const noise = run.noise || axes.map((x) => noiseOf(x, Math.max(least, 1e-6)));
  return {
    ...run,
    axes,
    t,
    samples,
    noise,
    impacts: run.impacts || impactsOf(axes[0], run.step),
    spread: run.spread || null,
  };
}

// First and last sample, exclusive, of each stretch.
function stretchBounds(run) {
  const at = (k) => (run.impacts.length > k ? Math.ceil(run.impacts[k] / run.step - 1e-9) : run.samples);
  return [
    [0, at(0)],
    [at(0), at(1)],
    [at(1), run.samples],
  ];
}

// Quadratic mean of model minus measured [deg/s] by stretch and axis, both counted from the release; NaN without samples.
function errorsOf(run, modelled) {
  const seen = modelled.length / 3;
  return stretchBounds(run).map(([a, b]) =>
    run.axes.map((x, axis) => {
      let sum = 0;
      const end = Math.min(b, seen);
      for (let i = a; i < end; i++) sum += (modelled[3 * i + axis] - x[i]) ** 2;
      return end - a >= 8 ? Math.sqrt(sum / (end - a)) : NaN;
    }),
  );
}

// One number for the error up to the second main impact, all axes [deg/s].
function totalError(run, modelled) {
  const bounds = stretchBounds(run);
  const end = Math.min(bounds[1][1], modelled.length / 3);
  let sum = 0;
  for (let i = 0; i < end; i++)
    for (let axis = 0; axis < 3; axis++) sum += (modelled[3 * i + axis] - run.axes[axis][i]) ** 2;
  return end ? Math.sqrt(sum / (3 * end)) : NaN;
}

// Rates of a record [rad/s] with what the model's sensor does to them undone: bias and drift, scale, misalignment.
function undoneRates(run, effects) {
  const radians = Math.PI / 180;
  const drift = effects.gyro_drift || {};
  const scale = effects.gyro_scale || { x: 1, y: 1, z: 1 };
  const sits = effects.gyro_misalignment || { x: 0, y: 0, z: 0 };
  // The inverse of a small turn is the turn back; what the axes lack to square is left.
  const back = smallTurn([-sits.x, -sits.y, -sits.z]);
  const letters = ["x", "y", "z"];
  return Array.from(run.t, (t, i) => {
    const w = letters.map(
      (a, k) => (run.axes[k][i] * radians - (drift["bias_" + a] || 0) - (drift["rate_" + a] || 0) * t) / scale[a],
    );
    return back.map((row) => row[0] * w[0] + row[1] * w[1] + row[2] * w[2]);
  });
}

// Rotations, body to plate, to which rates lead from the model's release: tilt, roll, turn every `every` samples.
function integrated(run, first, every, effects) {
  const rates = undoneRates(run, effects);
  let R = rotationOf(...first);
  const out = [];
  for (let i = 0; i < run.samples; i++) {
    if (i % every === 0)
      out.push(
        Math.atan2(-R[1][2], R[2][2]),
        Math.asin(Math.min(1, Math.max(-1, R[0][2]))),
        Math.atan2(-R[0][1], R[0][0]),
      );
    if (i + 1 < run.samples)
      R = times(R, smallTurn([0, 1, 2].map((k) => ((rates[i][k] + rates[i + 1][k]) / 2) * run.step)));
  }
  return Float32Array.from(out);
}

// Cayley's rotation of a small vector, right to its third power.
function smallTurn([x, y, z]) {
  const f = 1 / (1 + 0.25 * (x * x + y * y + z * z));
  const K = [
    [0, -z, y],
    [z, 0, -x],
    [-y, x, 0],
  ];
  const KK = times(K, K);
  return K.map((row, i) => row.map((v, j) => (i === j ? 1 : 0) + f * (v + 0.5 * KK[i][j])));
}

const times = (A, B) => A.map((row) => B[0].map((_, j) => row[0] * B[0][j] + row[1] * B[1][j] + row[2] * B[2][j]));
