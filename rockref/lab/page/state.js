"use strict";
// What the visitor has chosen: parameters, effects, releases, the run that is shown; undo, the address, the model file.
const unquoted = (value) => (value === "inf" ? Infinity : value === "-inf" ? -Infinity : value === null ? NaN : value);

function makeState(pack) {
  const catalogue = {};
  for (const effect of pack.effects) {
    const quantities = effect.quantities.map((q) => {
      const made = { ...q };
      for (const key of ["absent", "low", "high", "typical", "least", "most"]) made[key] = unquoted(q[key]);
      return made;
    });
    catalogue[effect.id] = { ...effect, quantities };
  }

  const typical = (id) =>
    Object.fromEntries(catalogue[id].quantities.map((q) => [q.name, Number.isNaN(q.typical) ? null : q.typical]));

  function started() {
    const effects = {};
    for (const [id, values] of Object.entries(pack.start.effects)) {
      effects[id] = {
        on: true,
        values: {
          ...typical(id),
          ...Object.fromEntries(Object.entries(values).map(([k, v]) => [k, v === null ? null : unquoted(v)])),
        },
      };
    }
    return { run: 0, numbers: { ...pack.start.numbers }, effects, releases: {} };
  }

  const state = { now: started(), past: [], future: [], catalogue, typical };
  const copy = (s) => structuredClone(s);

  state.commit = (before) => {
    if (JSON.stringify(before) === JSON.stringify(state.now)) return;
    state.past.push(before);
    if (state.past.length > 200) state.past.shift();
    state.future = [];
  };
  state.undo = () => {
    if (!state.past.length) return false;
    state.future.push(copy(state.now));
    state.now = state.past.pop();
    return true;
  };
  state.redo = () => {
    if (!state.future.length) return false;
    state.past.push(copy(state.now));
    state.now = state.future.pop();
    return true;
  };
  state.reset = () => {
    const before = copy(state.now);
    state.now = { ...started(), run: state.now.run };
    state.commit(before);
  };
  state.copy = () => copy(state.now);
  state.releaseOf = (id) => state.now.releases[id] || { tilt: 0, roll: 0 };

  // Effects that are on and not at the values at which they are absent.
  state.acting = () => {
    const found = {};
    for (const [id, effect] of Object.entries(state.now.effects)) {
      if (!effect.on) continue;
      const absent = catalogue[id].switches.every(
        (name) => effect.values[name] === catalogue[id].quantities.find((q) => q.name === name).absent,
      );
      if (!absent && (id !== "foot_defects" || state.now.numbers.points === 4)) found[id] = effect.values;
    }
    return found;
  };

  // The address: only what differs from the start.
  state.address = (extra) => {
    const words = new URLSearchParams(extra || {});
    const start = started();
    if (state.now.run) words.set("run", state.now.run);
    for (const [name, value] of Object.entries(state.now.numbers))
      if (value !== start.numbers[name]) words.set(name, value);
    for (const [id, effect] of Object.entries(state.now.effects)) {
      if (effect.on)
        words.set(
          id,
          Object.entries(effect.values)
            .filter(([, v]) => v !== null)
            .map(([k, v]) => k + ":" + v)
            .join(","),
        );
    }
    for (const id of Object.keys(start.effects))
      if (!state.now.effects[id] || !state.now.effects[id].on) words.set(id, "off");
    for (const [id, r] of Object.entries(state.now.releases))
      if (r.tilt || r.roll) words.set("release." + id, r.tilt + "," + r.roll);
    return words.toString();
  };

  state.readAddress = (text) => {
    const words = new URLSearchParams(text);
    for (const [key, value] of words) {
      if (key === "run") state.now.run = Math.max(0, Math.floor(Number(value)) || 0);
      else if (key.startsWith("release.")) {
        const [tilt, roll] = value.split(",").map(Number);
        if (Number.isFinite(tilt) && Number.isFinite(roll)) state.now.releases[key.slice(8)] = { tilt, roll };
      } else if (catalogue[key]) readEffect(key, value);
      else if (key in state.now.numbers && Number.isFinite(Number(value))) state.now.numbers[key] = Number(value);
    }
    return words;
  };

  function readEffect(id, value) {
    const values = typical(id);
    for (const word of value.split(",")) {
      const [name, number] = word.split(":");
      if (name in values && number !== undefined && !Number.isNaN(Number(number))) values[name] = Number(number);
    }
    state.now.effects[id] = { on: value !== "off", values };
  }
  return state;
}

// A model file that `rockref` reads. Every number reads back to the same bits: JavaScript writes the shortest that does.
function modelFile(state, theta, notes) {
  const n = state.now.numbers;
  const toml = (value) =>
    value === Infinity
      ? "inf"
      : value === -Infinity
        ? "-inf"
        : /[.e]/.test(String(value))
          ? String(value)
          : value + ".0";
  const lines = ["# A rockref model. SI units; the unit is in the key.", "format = 1", "", "[block]"];
  for (const [key, name] of [
    ["mass_kg", "mass"],
    ["width_m", "width"],
    ["depth_m", "depth"],
    ["height_m", "height"],
    ["g_m_s2", "g"],
  ])
    lines.push(key + " = " + toml(n[name]));
  const inertia = Array.from({ length: 9 }, (_, i) => n["inertia_" + i]);
  if (inertia.some((v) => v)) lines.push("inertia_kg_m2 = [" + inertia.map(toml).join(", ") + "]");
  lines.push(
    "",
    "[points]",
    'set = "' + (n.points === 4 ? "four_points" : "eight_points") + '"',
    "foot_radius_m = " + toml(n.foot_radius),
    "",
    "[parameters]",
  );
  for (const [key, name] of [
    ["K_N_N_m", "K_N"],
    ["K_T_N_m", "K_T"],
    ["beta_int", "beta_int"],
    ["beta_ext", "beta_ext"],
    ["mu_int", "mu_int"],
    ["mu_ext", "mu_ext"],
  ])
    lines.push(key + " = " + toml(n[name]));
  lines.push("delta_long_m = [" + [1, 2, 3, 4].map((i) => toml(n["delta_long_" + i])).join(", ") + "]");
  lines.push("delta_diag_m = " + toml(n.delta_diag), "theta_0_rad = " + toml(theta));
  for (const [id, values] of Object.entries(state.acting())) {
    lines.push("", "[effects." + id + "]");
    for (const [name, value] of Object.entries(values)) if (value !== null) lines.push(name + " = " + toml(value));
  }
  lines.push("", "[origin]");
  for (const [key, value] of Object.entries(notes)) lines.push(key + " = " + JSON.stringify(value));
  return lines.join("\n") + "\n";
}
