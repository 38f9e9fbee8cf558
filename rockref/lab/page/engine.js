"use strict";
// The law in its WebAssembly module: arrays in, arrays out. Rates are rad/s here, as in the C text.
function makeEngine(bytes, layout) {
  const code = new WebAssembly.Instance(new WebAssembly.Module(bytes), {}).exports;
  if (code._initialize) code._initialize();
  const C = layout.columns;
  const held = {};

  // A buffer of the module, made once for each name and made anew where it is too small.
  function buffer(name, count, bytesEach = 8) {
    const size = count * bytesEach;
    if (!held[name] || held[name].size < size) {
      if (held[name]) code.give_back(held[name].at);
      held[name] = { at: code.take(size), size: size };
    }
    return held[name].at;
  }

  const floats = (at, count) => new Float64Array(code.memory.buffer, at, count);

  function put(name, values) {
    const at = buffer(name, values.length);
    floats(at, values.length).set(values);
    return at;
  }

  function text(at, count) {
    return String.fromCharCode(...new Uint8Array(code.memory.buffer, at, count));
  }

  const modelRow = (numbers) => layout.model.map((name) => numbers[name] || 0);

  // The array of effects {id: {quantity: value}}: those that are there are on.
  function valueRow(effects) {
    const row = new Float64Array(layout.count);
    for (const [id, values] of Object.entries(effects)) {
      row[layout.values[id].on] = 1;
      for (const [name, value] of Object.entries(values)) row[layout.values[id][name]] = value === null ? NaN : value;
    }
    return row;
  }

  // A run from its release; rows of every `every`-th step stay in the module.
  function run(q) {
    const states = buffer("states", q.rows * C.STATE);
    const forces = buffer("forces", q.rows * q.points * 3);
    const model = put("model", modelRow(q.numbers));
    const values = put("values", valueRow(q.effects));
    const written = code.run_model(
      model,
      values,
      q.theta,
      q.turned ? 1 : 0,
      q.roll,
      q.step,
      q.every,
      q.rows,
      states,
      forces,
      0,
    );
    return { written: written, rows: q.rows, states: states, forces: forces, values: values, fine: q.step * q.every };
  }

  // What the gyroscope records of the rows of a run: (m, 3).
  function recorded(made, gyro, m) {
    const out = buffer("recorded", 3 * m);
    code.recorded(
      made.values,
      made.states + 8 * C.W_,
      C.STATE,
      made.written,
      made.fine,
      gyro.rate,
      gyro.bandwidth,
      gyro.range || 0,
      out,
      m,
    );
    return floats(out, 3 * m);
  }

  function digest(made) {
    const out = buffer("digest", 64, 1);
    code.digest_of(made.states, made.written, out);
    return text(out, 64);
  }

  // Innovations of one run that listens: whitened residuals, a copy.
  function innovations(q) {
    const r = buffer("innovations", 3 * q.samples);
    const left = code.innovations_of(
      put("model", q.row),
      put("values", q.values),
      q.gyro.rate,
      q.gyro.bandwidth,
      q.gyro.range || 0,
      q.theta,
      q.roll,
      q.turned ? 1 : 0,
      q.stage.rates,
      q.stage.attitude,
      q.stage.jitter,
      q.stage.steps,
      q.stage.smoothing,
      put("record" + q.id, q.record),
      q.samples,
      put("sigma", q.sigma),
      r,
    );
    return floats(r, 3 * left).slice();
  }

  return { code, C, buffer, floats, modelRow, valueRow, run, recorded, digest, innovations };
}
