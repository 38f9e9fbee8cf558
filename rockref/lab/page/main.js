"use strict";
// The page: what is touched changes the state, the state asks for a run, the run moves everything that is seen.
const lab = {};
// Step and rows of an exact run: the source's step, 4 kHz; and of one while a slider is dragged.
const EXACT = { step: 1e-5, every: 25 };
const COARSE = { step: 3.125e-5, every: 16 };

// The coarse step, finer for a block whose feet are stiffer for its mass.
function coarse(numbers) {
  const every = Math.ceil(COARSE.every * finer(numbers));
  return { step: (COARSE.step * COARSE.every) / every, every };
}

function startLab() {
  const pack = JSON.parse(document.getElementById("pack").textContent);
  const byId = (id) => document.getElementById(id);
  const state = makeState(pack);
  const view = { azimuth: -2.15, elevation: 0.24, times: 40, ghost: true, frame: 0, playing: false, speed: 0.05 };
  const scene = makeScene(byId("block"), view);
  const errors = makeErrors(byId("errors"));
  const worker = startWorker({ ...pack, for_worker: workerFacts(pack, state) });
  let experiment = null;
  let last = null;
  let before = state.copy();

  const curves = makeCurves(byId("curves"), (t) => {
    play(false);
    seek(t * 500);
  });
  const shownRun = () => experiment.runs[Math.min(state.now.run, experiment.runs.length - 1)];
  const thetaOf = (run) => run.tilt + state.releaseOf(run.id).tilt;

  function question(run, how, end) {
    return {
      ...how,
      numbers: state.now.numbers,
      effects: state.acting(),
      theta: thetaOf(run),
      roll: state.releaseOf(run.id).roll,
      turned: run.turned,
      end,
      samples: Math.floor(end / run.step + 1e-6) + 1,
      gyro: workerGyro({ ...experiment.gyro, rate: 1 / run.step }),
    };
  }

  // The state has changed: compute the run that is shown, coarsely while something is dragged.
  function update(done) {
    const run = shownRun();
    const whole = run.t[run.samples - 1];
    const clock = state.acting().clock_error;
    // A clock whose rate moves is slower by a twentieth at most than at the release.
    const slow = clock ? clock.rate * (clock.growth ? 1.05 : 1) : 1;
    const reach = (done ? whole : Math.min(whole, curves.range()[1])) * Math.max(1, slow);
    document.body.dataset.busy = "true";
    const asked = worker.run(
      {
        ...question(run, done ? EXACT : coarse(state.now.numbers), reach),
        samples: Math.floor(Math.min(whole, reach) / run.step + 1e-6) + 1,
      },
      (answer, q) => shown(run, answer, q),
    );
    if (done) remember();
    return asked;
  }

  function shown(run, answer, q) {
    document.body.dataset.busy = "false";
    if (!answer.rates) {
      byId("said").textContent = "The model has no run at these numbers.";
      return;
    }
    last = { run, answer, exact: q.step === EXACT.step };
    const found = errorsOf(run, answer.rates);
    lab.errors = found;
    lab.total = totalError(run, answer.rates);
    errors.show(run, found);
    curves.show(run, answer, pack.points[String(answer.points)]);
    const n = state.now.numbers;
    const spin = run.turned ? Math.PI : 0;
    ghostOf(run, answer, q.effects);
    scene.show({
      ...answer,
      ghost: run.ghost,
      n: answer.points,
      points: pointsOf(n),
      box: [n.width, n.depth, n.height],
      weight: n.mass * n.g,
      spin,
    });
    draw();
    const noise = Math.sqrt(run.noise.reduce((s, v) => s + v * v, 0) / 3);
    byId("total").textContent = short(lab.total);
    byId("noise-total").textContent = short(noise);
    document.body.dataset.exact = String(last.exact);
    if (last.exact) {
      byId("said").textContent =
        "Run " +
        run.id +
        ": error " +
        short(lab.total) +
        " degrees per second to the second main impact; noise " +
        short(noise) +
        ".";
    }
    byId("overturned").hidden = !answer.lost;
  }

  // The measured block, by its rates as the model's sensor reads them, from the model's release.
  function ghostOf(run, answer, effects) {
    const key = JSON.stringify([
      effects.gyro_drift,
      effects.gyro_scale,
      effects.gyro_misalignment,
      state.releaseOf(run.id),
      run.tilt,
    ]);
    if (run.ghostKey === key) return;
    run.ghostKey = key;
    run.ghost = integrated(run, answer.angles.slice(0, 3), Math.max(1, Math.round(0.002 / run.step)), effects);
  }

  // Animation.
  const frames = () => (last ? last.answer.frames : 1);
  function draw() {
    scene.draw(view.frame);
    const t = Math.floor(view.frame) / 500;
    byId("clock").textContent = t.toFixed(3) + " s";
    byId("instant").max = frames() - 1;
    byId("instant").value = Math.floor(view.frame);
    curves.seek(t);
    byId("block").dataset.frame = Math.floor(view.frame);
  }
  function seek(frame) {
    view.frame = Math.min(Math.max(frame, 0), frames() - 1);
    draw();
  }
  let then = 0;
  function tick(now) {
    if (!view.playing) return;
    view.frame += ((then ? now - then : 0) / 1000) * view.speed * 500;
    then = now;
    if (view.frame / 500 > curves.range()[1] || view.frame >= frames() - 1)
      view.frame = Math.max(0, curves.range()[0] * 500);
    draw();
    requestAnimationFrame(tick);
  }
  function play(on) {
    view.playing = on;
    then = 0;
    byId("play").textContent = on ? "❚❚ pause" : "▶ play";
    byId("play").setAttribute("aria-label", on ? "pause" : "play");
    if (on) requestAnimationFrame(tick);
  }

  // Sliders and switches.
  function changeNumber(name, value, done) {
    state.now.numbers[name] = value;
    update(done);
    if (done) keep();
  }
  function changeEffect(id, name, value, done) {
    if (!state.now.effects[id]) state.now.effects[id] = { on: false, values: state.typical(id) };
    if (name === null) state.now.effects[id].on = value;
    else {
      state.now.effects[id].values[name] = value;
      state.now.effects[id].on = true;
    }
    showEffect(id);
    update(done);
    if (done) keep();
  }
  function changeRelease(name, value, done) {
    const run = shownRun();
    const at = { ...state.releaseOf(run.id) };
    at[name] = name === "tilt" ? value - run.tilt : value;
    state.now.releases[run.id] = at;
    update(done);
    if (done) keep();
  }
  const parameters = parameterSliders(pack, byId("parameters"), changeNumber);
  const switches = effectSwitches(state, byId("effects"), changeEffect);
  let releases = [];

  function showEffect(id) {
    const effect = state.now.effects[id];
    const on = Boolean(effect && effect.on);
    switches[id].input.checked = on;
    switches[id].inside.hidden = !on;
    switches[id].item.classList.toggle("on", on);
    if (effect)
      for (const [name, made] of Object.entries(switches[id].sliders))
        if (effect.values[name] !== null) made.set(effect.values[name]);
    byId("how-many").textContent = String(Object.values(state.now.effects).filter((e) => e.on).length || "");
  }
  function showReleases() {
    const run = shownRun();
    const at = state.releaseOf(run.id);
    const host = byId("release");
    host.textContent = "";
    const wide = 3 * experiment.tilt_uncertainty;
    releases = [
      slider({
        key: "theta_0",
        symbol: "θ₀",
        label: "release tilt of this run",
        unit: "rad",
        low: run.tilt - wide,
        high: run.tilt + wide,
        log: false,
        centre: run.tilt,
        spread: experiment.tilt_uncertainty,
        reset: run.tilt,
        change: (v, done) => changeRelease("tilt", v, done),
      }),
      slider({
        key: "roll",
        symbol: "ρ",
        label: "roll at the release",
        unit: "rad",
        low: -3 * pack.roll_uncertainty,
        high: 3 * pack.roll_uncertainty,
        log: false,
        centre: 0,
        spread: pack.roll_uncertainty,
        reset: 0,
        factor: 1e3,
        shownUnit: "mrad",
        change: (v, done) => changeRelease("roll", v, done),
      }),
    ];
    releases[0].set(run.tilt + at.tilt);
    releases[1].set(at.roll);
    releases.forEach((s) => host.append(s.row));
  }
  function showAll() {
    for (const [name, made] of Object.entries(parameters)) made.set(state.now.numbers[name]);
    for (const id of Object.keys(switches)) showEffect(id);
    byId("runs").value = String(Math.min(state.now.run, experiment.runs.length - 1));
    showReleases();
    byId("undo").disabled = !state.past.length;
    byId("redo").disabled = !state.future.length;
  }

  // History and the address.
  function keep() {
    state.commit(before);
    before = state.copy();
    byId("undo").disabled = !state.past.length;
    byId("redo").disabled = !state.future.length;
  }
  function remember() {
    const words = state.address(lab.seed ? { seed: lab.seed } : {});
    try {
      history.replaceState(null, "", words ? "#" + words : location.pathname + location.search);
    } catch {
      location.hash = words;
    }
  }
  function apply(model) {
    state.now.numbers = { ...state.now.numbers, ...model.numbers };
    for (const effect of Object.values(state.now.effects)) effect.on = false;
    for (const [id, values] of Object.entries(model.effects))
      state.now.effects[id] = { on: true, values: { ...state.typical(id), ...values } };
    if (model.releases)
      experiment.runs
        .filter((r) => r.use === "fit")
        .forEach((run, k) => {
          state.now.releases[run.id] = model.releases[k];
        });
    showAll();
  }

  function useExperiment(given) {
    experiment = { ...given, runs: given.runs.map((run) => prepareRun(run, given.gyro)) };
    lab.experiment = experiment;
    state.now.run = Math.min(state.now.run, experiment.runs.length - 1);
    const box = byId("runs");
    box.textContent = "";
    experiment.runs.forEach((run, k) =>
      box.append(
        element(
          "option",
          { value: k },
          "run " +
            run.id +
            (run.turned ? ", turned" : "") +
            ", " +
            run.tilt.toFixed(3) +
            " rad" +
            (run.use === "holdout" ? ", held out" : ""),
        ),
      ),
    );
    byId("name").textContent = experiment.name;
    byId("home").hidden = !pack.experiment || given === pack.experiment;
    zoomTo("second");
    before = state.copy();
    showAll();
    return update(true);
  }
  function zoomTo(where) {
    const run = shownRun();
    const [first, second] = [run.impacts[0] || run.t[run.samples - 1], run.impacts[1] || run.t[run.samples - 1]];
    const end = run.t[run.samples - 1];
    const ranges = {
      whole: [0, end],
      second: [0, Math.min(end, second + 0.12)],
      impact: [Math.max(0, first - 0.06), Math.min(end, first + 0.14)],
    };
    curves.zoom(...ranges[where]);
  }

  wire({
    byId,
    state,
    view,
    worker,
    pack,
    draw,
    seek,
    play,
    update,
    showAll,
    keep,
    apply,
    remember,
    useExperiment,
    zoomTo,
    shownRun,
    thetaOf,
    changed: () => {
      before = state.copy();
    },
  });
  Object.assign(lab, {
    state,
    view,
    worker,
    curves,
    scene,
    pack,
    update,
    seek,
    play,
    apply,
    useExperiment,
    question,
    EXACT,
    COARSE,
    last: () => last,
    get experiment() {
      return experiment;
    },
    set experiment(e) {
      experiment = e;
    },
  });

  worker.begin().then(async () => {
    const words = state.readAddress(location.hash.slice(1));
    const seed = Number(words.get("seed")) || (pack.experiment ? 0 : 1);
    if (seed && (words.get("seed") || !pack.experiment)) await lab.mystery(seed, false);
    else await useExperiment(pack.experiment);
    await lab.badge();
    document.body.dataset.state = "ready";
  });
}

// What the worker has to know of the catalogue.
function workerFacts(pack, state) {
  const defaults = {};
  const switches = {};
  const hideable = {};
  for (const effect of Object.values(state.catalogue)) {
    defaults[effect.id] = state.typical(effect.id);
    for (const q of effect.quantities)
      if (effect.switches.includes(q.name) && !Number.isNaN(q.absent)) defaults[effect.id][q.name] = q.absent;
    switches[effect.id] = effect.switches.map((name) => [name, effect.quantities.find((q) => q.name === name).absent]);
    const items = effectItems(effect, null, false);
    if (items.length && !["foot_defects", "gyro_saturation"].includes(effect.id)) hideable[effect.id] = items;
  }
  return { defaults, switches, hideable, shared: sharedItems(pack, pack.start.numbers) };
}
