"use strict";
// Files of the visitor's own: a table of time and three rates, in text. Nothing leaves the page.
const TIME_NAMES = /^(t|time|zeit|timestamp|temps|tempo)\b/i;
const RATE_NAMES = /gyr|omega|rate|^w ?[xyz]|drehrate|angular|velocity/i;
// A rate without a unit that is larger than this is taken for degrees a second: no block rocks at 10 rad/s.
const MOST_RADIANS = 10;

// The table of a text: names and columns of numbers. Throws an Error that says what is missing.
function readTable(text) {
  const lines = text
    .replace(/^\ufeff/, "")
    .split(/\r?\n/)
    .filter((line) => line.trim() && !line.startsWith("#"));
  if (lines.length < 20) throw new Error("has fewer than 20 rows");
  const separator = [";", "\t", ","].find((c) => lines[1].includes(c)) || /\s+/;
  const comma = separator !== "," && /\d,\d/.test(lines[lines.length - 1]);
  const cells = (line) =>
    line
      .trim()
      .split(separator)
      .map((c) => c.trim().replace(/^"|"$/g, ""));
  const number = (cell) => (cell === "" || cell === undefined ? NaN : Number(comma ? cell.replace(",", ".") : cell));
  const first = lines.findIndex((line) => {
    const row = cells(line);
    return row.length > 3 && row.every((c) => !Number.isNaN(number(c)) || c === "");
  });
  if (first < 0) throw new Error("has no rows of four numbers");
  const names = first > 0 ? cells(lines[first - 1]) : [];
  const rows = lines
    .slice(first)
    .map((line) => cells(line).map(number))
    .filter((row) => row.length > 3 && row.slice(0, 4).every(Number.isFinite));
  return { names, columns: rows[0].map((_, k) => Float64Array.from(rows, (row) => row[k])) };
}

const secondsOf = (name, t) =>
  /\bus\b|_us|µs|micro/i.test(name)
    ? 1e-6
    : /\bms\b|_ms|milli/i.test(name)
      ? 1e-3
      : /\bns\b|_ns/i.test(name) || t[1] - t[0] > 1e5
        ? 1e-9
        : 1;

// Time [s] and three rates [deg/s] of a table: by name, else the first four columns.
function signalOf(table) {
  const named = table.names.map((name, k) => [name, k]);
  const time = (named.find(([name]) => TIME_NAMES.test(name)) || ["", 0])[1];
  let rates = named
    .filter(([name, k]) => k !== time && RATE_NAMES.test(name) && !/abs/i.test(name))
    .map(([, k]) => k)
    .slice(0, 3);
  if (rates.length < 3)
    rates = table.columns
      .map((_, k) => k)
      .filter((k) => k !== time)
      .slice(0, 3);
  if (rates.length < 3) throw new Error("has no three rates");
  const factor = secondsOf(table.names[time] || "", table.columns[time]);
  const most = Math.max(...rates.map((k) => table.columns[k].reduce((m, v) => Math.max(m, Math.abs(v)), 0)));
  const words = rates.map((k) => table.names[k] || "").join(" ");
  const radians = /rad/i.test(words) || (!/deg|°|dps/i.test(words) && most < MOST_RADIANS);
  const unit = radians ? (/mrad/i.test(words) ? 0.18 / Math.PI : 180 / Math.PI) : 1;
  return {
    t: table.columns[time].map((v) => v * factor),
    rates: rates.map((k) => table.columns[k].map((v) => v * unit)),
  };
}

// The release: where the main rate, which grows in proportion to the time at first, comes from zero.
function releaseTime(signal) {
  const x = signal.rates[0];
  const noise = noiseOf(x, 1e-6);
  const rest = median(x.slice(0, Math.max(8, Math.floor(0.02 * x.length))));
  const most = x.reduce((m, v) => Math.max(m, Math.abs(v - rest)), 0);
  const reached = (level) => x.findIndex((v) => Math.abs(v - rest) > level);
  const high = reached(Math.max(0.15 * most, 12 * noise));
  const low = reached(Math.max(0.05 * most, 6 * noise));
  if (high <= low || low < 2) return signal.t[0];
  const slope = (x[high] - x[low]) / (signal.t[high] - signal.t[low]);
  return Math.max(signal.t[0], signal.t[low] - (x[low] - rest) / slope);
}

// Even samples from the release on, as far as the record goes.
function evenRun(id, signal, release, tilt) {
  const steps = Float64Array.from({ length: signal.t.length - 1 }, (_, i) => signal.t[i + 1] - signal.t[i]);
  const step = Number(median(steps).toPrecision(6));
  if (!(step > 0 && step < 0.02))
    throw new Error("is sampled every " + step + " s; the block needs 50 a second or more");
  const count = Math.floor((signal.t[signal.t.length - 1] - release) / step) + 1;
  const rates = new Float64Array(3 * count);
  let i = 0;
  for (let k = 0; k < count; k++) {
    const at = release + k * step;
    while (i < signal.t.length - 2 && signal.t[i + 1] < at) i++;
    const f = Math.min(1, Math.max(0, (at - signal.t[i]) / (signal.t[i + 1] - signal.t[i])));
    signal.rates.forEach((x, axis) => {
      rates[3 * k + axis] = x[i] + f * (x[i + 1] - x[i]);
    });
  }
  // The main rate is positive in the first swing of a block that is not turned.
  const early = rates.filter((_, j) => j % 3 === 0 && j < 3 * Math.round(0.3 / step)).reduce((s, v) => s + v, 0);
  return { id, use: "fit", tilt, turned: early < 0, step, rates };
}

function wireOwn(at) {
  const { byId, state, pack } = at;
  const say = (text) => {
    byId("own-said").textContent = text;
  };
  const files = [];
  const field = (id) => Number(byId(id).value);
  for (const name of ["mass", "width", "depth", "height"]) byId("own-" + name).value = state.now.numbers[name];
  byId("own-tilt").value = pack.start.numbers.theta_0;

  async function use() {
    const runs = [];
    for (const file of files) {
      try {
        const signal = signalOf(readTable(file.text));
        runs.push(
          evenRun(file.name.replace(/\.[^.]*$/, "").slice(0, 24), signal, releaseTime(signal), field("own-tilt")),
        );
      } catch (error) {
        say(file.name + " " + error.message + ".");
        return;
      }
    }
    const n = state.now.numbers;
    for (const name of ["mass", "width", "depth", "height"])
      if (field("own-" + name) > 0) n[name] = field("own-" + name);
    const rate = 1 / runs[0].step;
    lab.seed = 0;
    byId("guess-box").hidden = true;
    await at.useExperiment({
      name: "your data",
      gyro: { rate, bandwidth: field("own-bandwidth") || 0.4 * rate, noise: 0, resolution: 0, range: null },
      tilt_uncertainty: 5e-3,
      runs,
    });
    say(
      runs.length +
        (runs.length === 1 ? " run" : " runs") +
        " read: " +
        runs.map((r) => r.id + ", " + rate.toFixed(0) + " Hz" + (r.turned ? ", turned" : "")).join("; ") +
        ". Check the tilt, then fit.",
    );
  }
  async function take(list) {
    files.length = 0;
    for (const file of list) files.push({ name: file.name, text: await file.text() });
    if (files.length) {
      byId("own").open = true;
      await use();
    }
  }
  lab.take = (name, text) => {
    files.length = 0;
    files.push({ name, text });
    byId("own").open = true;
    return use();
  };
  byId("own-files").addEventListener("change", (e) => take(e.target.files));
  for (const id of ["own-mass", "own-width", "own-depth", "own-height", "own-tilt", "own-bandwidth"])
    byId(id).addEventListener("change", () => {
      if (files.length) use();
    });
  const stop = (e) => {
    e.preventDefault();
    document.body.dataset.drop = String(e.type === "dragover");
  };
  for (const kind of ["dragover", "dragleave"]) addEventListener(kind, stop);
  addEventListener("drop", (e) => {
    stop(e);
    take(e.dataTransfer.files);
  });
}
