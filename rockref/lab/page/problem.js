"use strict";
// What a fit moves: parameters, releases and the numbers of effects, each with centre, spread and map; `z` is where it
// stands, in prior deviations.
const WITHIN = { least: -Infinity, most: Infinity, positive: false };

function sharedItems(pack, numbers) {
  return pack.parameters
    .filter((p) => p.name !== "theta_0" && p.acts)
    .map((p) => {
      const given = Math.log(Math.max(numbers[p.name], 1e-12) / p.centre) / p.spread;
      return {
        ...WITHIN,
        kind: "parameter",
        name: p.name,
        map: "log",
        centre: p.centre,
        spread: p.spread,
        z: Math.min(Math.max(given, -6), 6),
      };
    });
}

function releaseItems(runs, state, uncertainty, rollUncertainty) {
  return runs.flatMap((run, k) => {
    const at = state.releaseOf(run.id);
    const item = (name, spread) => ({
      ...WITHIN,
      kind: "release",
      run: k,
      name,
      map: "linear",
      centre: 0,
      spread,
      z: at[name] / spread,
    });
    return [item("tilt", uncertainty), item("roll", rollUncertainty)];
  });
}

// The numbers of an effect that a fit can move. Those of a typical size of nothing, directions and shares, stay as they
// stand; those that only shape the effect come last and are left out of a first look.
function effectItems(effect, values, shapes) {
  const bring = effect.quantities.filter(
    (q) => effect.switches.includes(q.name) && q.typical !== q.absent && !Number.isNaN(q.absent),
  );
  const shape = shapes
    ? effect.quantities.filter((q) => !effect.switches.includes(q.name) && q.sign === "+" && q.absent > 0)
    : [];
  return [...bring.map((q) => amplitudeItem(effect, q, values)), ...shape.map((q) => shapeItem(effect, q, values))];
}

function shapeItem(effect, q, values) {
  const value = values ? values[q.name] : q.typical;
  return {
    kind: "effect",
    effect: effect.id,
    name: q.name,
    map: "log",
    centre: q.typical,
    spread: 0.5,
    positive: false,
    least: q.least,
    most: q.most,
    z: Math.log(value / q.typical) / 0.5,
  };
}

// Three typical sizes are one prior deviation; factors about one by their logarithm, at most a half.
function amplitudeItem(effect, q, values) {
  const item = {
    kind: "effect",
    effect: effect.id,
    name: q.name,
    positive: q.sign === "+",
    least: q.least,
    most: q.most,
    typical: q.typical,
    typical_z: 1 / 3,
  };
  const value = values ? values[q.name] : q.absent;
  if (effect.id === "compliant_support") {
    return {
      ...item,
      map: "compliance",
      positive: true,
      least: 0,
      most: Infinity,
      seeded: true,
      z: value > 0 ? (q.typical / value) ** 2 / 3 : 0,
    };
  }
  if (q.absent === Infinity)
    return {
      ...item,
      map: "inverse",
      positive: true,
      least: 0,
      most: Infinity,
      z: Number.isFinite(value) ? q.typical / value / 3 : 0,
      seeded: effect.id === "gyro_saturation",
    };
  if (q.absent === 1 && q.sign !== "+") {
    const size = Math.abs(Math.log(q.typical)) || Math.abs(Math.log(q.high)) / 2;
    const spread = Math.min(3 * size, 0.5);
    return {
      ...item,
      map: "log",
      centre: 1,
      spread,
      typical_z: size / spread,
      z: Math.log(Math.max(value, 1e-6)) / spread,
    };
  }
  const spread = 3 * Math.abs(q.typical - q.absent);
  return { ...item, map: "linear", centre: q.absent, spread, z: (value - q.absent) / spread };
}

// What the worker needs to fit or to rank: 2.2 times the way to the first main impact of each fit run, which holds one
// whole arc and its two impacts.
const HORIZON = 2.2;
// The part of the way to the first main impact in which no foot is lost.
const EARLY = 0.85;

// How much finer steps have to be than for the block of Table 3.1: contacts are faster by the root of stiffness over mass.
function finer(n) {
  return Math.max(1, Math.sqrt(Math.max(n.K_N, n.K_T) / n.mass / (6e7 / 54)));
}

function fitProblem(pack, state, experiment) {
  const runs = experiment.runs.filter((run) => run.use === "fit");
  const acting = state.acting();
  const radians = Math.PI / 180;
  const items = [
    ...sharedItems(pack, state.now.numbers),
    ...releaseItems(runs, state, experiment.tilt_uncertainty, pack.roll_uncertainty),
    ...Object.entries(acting).flatMap(([id, values]) => effectItems(state.catalogue[id], values, true)),
  ];
  return {
    numbers: state.now.numbers,
    finer: finer(state.now.numbers),
    effects: acting,
    gyro: workerGyro(experiment.gyro),
    items,
    runs: runs.map((run) => {
      const end = run.impacts.length ? HORIZON * run.impacts[0] : 1.2;
      const samples = Math.min(run.samples, Math.ceil(end / run.step));
      const record = new Float64Array(3 * samples);
      for (let i = 0; i < samples; i++) for (let k = 0; k < 3; k++) record[3 * i + k] = run.axes[k][i] * radians;
      const early = Math.min(samples, Math.max(40, Math.floor((EARLY / HORIZON) * samples)));
      return {
        record,
        samples,
        early,
        tilt: run.tilt,
        turned: run.turned,
        sigma: run.noise.map((v) => v * radians),
        offset: state.releaseOf(run.id),
      };
    }),
  };
}

// The gyroscope in the units of the module.
function workerGyro(gyro) {
  return { ...gyro, range: gyro.range ? (gyro.range * Math.PI) / 180 : 0 };
}

// Effects that are not on, each with the numbers by which it enters.
function candidates(state) {
  const on = state.acting();
  const found = {};
  for (const effect of Object.values(state.catalogue)) {
    if (
      on[effect.id] ||
      (effect.id === "foot_defects") !== (state.now.numbers.points === 4 && effect.id === "foot_defects")
    )
      continue;
    const items = effectItems(effect, null, false);
    if (items.length) found[effect.id] = items;
  }
  return found;
}
