"use strict";
// Sliders and switches. A slider has a thousand places on a straight or a logarithmic scale; the prior is its shading.
const PLACES = 1000;

function element(tag, attributes, text) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

const withUnit = (value, unit) =>
  Number(value.toPrecision(4)).toString() +
  (unit === "1" || !unit ? "" : "\u202f" + unit.replace("m2", "m²").replace("s2", "s²"));

function scaleOf(low, high, log) {
  const to = log ? Math.log : (v) => v;
  const from = log ? Math.exp : (v) => v;
  return {
    place: (v) => (PLACES * (to(v) - to(low))) / (to(high) - to(low)),
    value: (p) => from(to(low) + (p / PLACES) * (to(high) - to(low))),
  };
}

// Shading of a prior about its centre: two deviations fade out on either side.
function shading(scale, centre, spread, log) {
  const at = (z) =>
    Math.min(100, Math.max(0, scale.place(log ? centre * Math.exp(z * spread) : centre + z * spread) / (PLACES / 100)));
  const tone = (z) => "color-mix(in srgb, var(--prior) " + Math.round(100 * Math.exp((-z * z) / 2)) + "%, transparent)";
  const stops = [-3, -2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2, 3].map((z) => tone(z) + " " + at(z).toFixed(1) + "%");
  return "linear-gradient(90deg, " + stops.join(", ") + ")";
}

// One slider: {label, symbol, unit, low, high, log, centre, spread, reset, change(value, done)}.
function slider(q) {
  const row = element("div", { class: "slider" });
  const id = "s-" + q.key;
  const label = element("label", { for: id });
  label.append(element("span", { class: "symbol" }, q.symbol), element("span", { class: "words" }, q.label));
  const input = element("input", { id, type: "range", min: 0, max: PLACES, step: 1, "data-key": q.key });
  const output = element("output", { for: id });
  const scale = scaleOf(q.low, q.high, q.log);
  if (q.spread) input.style.setProperty("--shade", shading(scale, q.centre, q.spread, q.priorLog));
  const tell = (value) => {
    output.textContent = withUnit(value * (q.factor || 1), q.shownUnit || q.unit);
    input.setAttribute("aria-valuetext", output.textContent);
  };
  const set = (value) => {
    input.value = Math.round(scale.place(value));
    tell(value);
  };
  input.addEventListener("input", () => {
    const v = scale.value(Number(input.value));
    tell(v);
    q.change(v, false);
  });
  input.addEventListener("change", () => q.change(scale.value(Number(input.value)), true));
  input.addEventListener("dblclick", () => {
    set(q.reset);
    q.change(q.reset, true);
  });
  row.append(label, input, output);
  return { row, input, set };
}

const SYMBOLS = {
  K_N: "K_N",
  K_T: "K_T",
  beta_int: "β int",
  beta_ext: "β ext",
  mu_int: "μ int",
  mu_ext: "μ ext",
  delta_long_1: "δ₁",
  delta_long_2: "δ₂",
  delta_long_3: "δ₃",
  delta_long_4: "δ₄",
  delta_diag: "δ diag",
  theta_0: "θ₀",
};

function parameterSliders(pack, host, change) {
  const made = {};
  for (const p of pack.parameters) {
    if (p.name === "theta_0") continue;
    const length = p.unit === "m";
    const height = p.name.startsWith("delta_long");
    const stiff = p.unit === "N/m";
    made[p.name] = slider({
      key: p.name,
      symbol: SYMBOLS[p.name],
      label: p.words,
      unit: p.unit,
      low: p.low,
      high: p.high,
      log: !height,
      centre: p.centre,
      spread: p.spread,
      priorLog: true,
      reset: pack.start.numbers[p.name],
      factor: height ? 1e6 : length ? 1e3 : stiff ? 1e-6 : 1,
      shownUnit: height ? "µm" : length ? "mm" : stiff ? "MN/m" : p.unit,
      change: (value, done) => change(p.name, value, done),
    });
    made[p.name].input.disabled = !p.acts;
    host.append(made[p.name].row);
  }
  return made;
}

const plainName = (id) => id.replace(/_/g, " ");

// The span of a slider of an effect: what is plausible, from absent on.
function spanOf(q) {
  if (q.absent === Infinity) return [q.low, q.high, true];
  const low = q.sign === "+" && q.absent !== null && !Number.isNaN(q.absent) ? Math.min(q.absent, q.low) : q.low;
  return [
    Number.isNaN(q.absent) ? q.low : Math.min(low, q.absent),
    Math.max(q.high, Number.isNaN(q.absent) ? q.high : q.absent),
    false,
  ];
}

function effectSwitch(effect, state, change) {
  const item = element("div", { class: "effect", "data-effect": effect.id });
  const input = element("input", { id: "e-" + effect.id, type: "checkbox", role: "switch" });
  const label = element("label", { for: "e-" + effect.id }, plainName(effect.id));
  const head = element("div", { class: "head" });
  head.append(input, label);
  const inside = element("div", { class: "inside" });
  inside.append(element("p", { class: "note" }, effect.sentence));
  const sliders = {};
  for (const q of effect.quantities) {
    const [low, high, log] = spanOf(q);
    if (!(high > low)) continue;
    sliders[q.name] = slider({
      key: effect.id + "." + q.name,
      symbol: q.name,
      label: q.meaning,
      unit: q.unit,
      low,
      high,
      log,
      reset: Number.isNaN(q.typical) ? (low + high) / 2 : q.typical,
      change: (value, done) => change(effect.id, q.name, value, done),
    });
    inside.append(sliders[q.name].row);
  }
  input.addEventListener("change", () => change(effect.id, null, input.checked, true));
  item.append(head, inside);
  return { item, input, sliders, inside };
}

function effectSwitches(state, host, change) {
  const made = {};
  const groups = {};
  for (const effect of Object.values(state.catalogue)) {
    if (!groups[effect.question]) {
      groups[effect.question] = element("div", { class: "group", role: "group", "aria-label": effect.question });
      groups[effect.question].append(element("h3", {}, effect.question));
      host.append(groups[effect.question]);
    }
    made[effect.id] = effectSwitch(effect, state, change);
    groups[effect.question].append(made[effect.id].item);
  }
  return made;
}
