"use strict";
// Buttons: animation, zoom, undo and redo, the model file, the badge.
function wire(at) {
  const { byId, state, view } = at;
  const click = (id, act) => byId(id).addEventListener("click", act);

  click("play", () => at.play(!view.playing));
  click("back", () => {
    at.play(false);
    at.seek(Math.floor(view.frame) - 1);
  });
  click("on", () => {
    at.play(false);
    at.seek(Math.floor(view.frame) + 1);
  });
  byId("instant").addEventListener("input", (e) => {
    at.play(false);
    at.seek(Number(e.target.value));
  });
  for (const [text, value] of SPEEDS) byId("speed").append(element("option", { value }, text));
  byId("speed").value = view.speed;
  byId("speed").addEventListener("change", (e) => {
    view.speed = Number(e.target.value);
  });
  byId("times").addEventListener("input", (e) => {
    view.times = Number(e.target.value);
    byId("times-shown").textContent = "×" + view.times;
    at.draw();
  });
  byId("ghost").addEventListener("change", (e) => {
    view.ghost = e.target.checked;
    at.draw();
  });
  for (const where of ["whole", "second", "impact"]) click("zoom-" + where, () => at.zoomTo(where));
  byId("runs").addEventListener("change", (e) => {
    state.now.run = Number(e.target.value);
    at.showAll();
    at.zoomTo("second");
    at.update(true);
    at.keep();
  });

  function moved(done) {
    if (done) {
      at.changed();
      at.showAll();
      at.update(true);
    }
  }
  click("undo", () => moved(state.undo()));
  click("redo", () => moved(state.redo()));
  click("reset", () => {
    state.reset();
    at.changed();
    at.showAll();
    at.update(true);
  });
  addEventListener("keydown", (e) => {
    if (!(e.ctrlKey || e.metaKey) || /^(text|number|search)$/.test(e.target.type || "")) return;
    if (e.key === "z") {
      e.preventDefault();
      moved(e.shiftKey ? state.redo() : state.undo());
    }
    if (e.key === "y") {
      e.preventDefault();
      moved(state.redo());
    }
  });

  turnByHand(byId("block"), view, at.draw);
  new ResizeObserver(() => at.draw()).observe(byId("block"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => at.draw());

  lab.modelText = () => {
    const notes = { source: "rockref lab " + at.pack.version, experiment: lab.experiment.name, run: at.shownRun().id };
    for (const run of lab.experiment.runs) {
      const r = state.releaseOf(run.id);
      if (r.tilt || r.roll)
        notes["release_" + run.id] = "tilt " + (run.tilt + r.tilt) + " rad, roll " + r.roll + " rad";
    }
    return modelFile(state, at.thetaOf(at.shownRun()), notes);
  };
  click("export", () => {
    const link = element("a", {
      download: "model.toml",
      href: URL.createObjectURL(new Blob([lab.modelText()], { type: "application/toml" })),
    });
    document.body.append(link);
    link.click();
    link.remove();
  });

  // The badge: golden runs anew, digests compared.
  lab.badge = async () => {
    const badge = byId("badge");
    badge.dataset.state = "running";
    byId("badge-text").textContent = "computing…";
    const found = await at.worker.send({ kind: "badge" });
    const good = found.runs.every((run) => run.same);
    lab.bits = found;
    badge.dataset.state = good ? "good" : "bad";
    byId("badge-text").textContent = good ? "the law’s bits" : "other bits than the law’s";
    const words = found.runs
      .map((run) => (run.same ? "✓ " : "✗ ") + run.title + ": " + run.found.slice(0, 12) + "…")
      .join("\n");
    badge.title =
      words +
      "\n" +
      (found.steps / found.elapsed / 1e3).toFixed(1) +
      " million steps a second. Click to compute them again.";
    badge.setAttribute(
      "aria-label",
      (good ? "This page has the law's bits" : "This page has other bits than the law's") +
        "; click to compute the golden runs again",
    );
  };
  click("badge", () => lab.badge());
  wireSearch(at);
  wireOwn(at);
}

function turnByHand(canvas, view, draw) {
  let from = null;
  canvas.addEventListener("pointerdown", (e) => {
    from = [e.clientX, e.clientY];
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointerup", () => {
    from = null;
  });
  canvas.addEventListener("pointermove", (e) => {
    if (!from) return;
    view.azimuth -= 0.01 * (e.clientX - from[0]);
    view.elevation = Math.min(1.4, Math.max(0.02, view.elevation + 0.01 * (e.clientY - from[1])));
    from = [e.clientX, e.clientY];
    draw();
  });
  canvas.addEventListener("keydown", (e) => {
    const turn = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.06], ArrowDown: [0, -0.06] }[e.key];
    if (!turn) return;
    e.preventDefault();
    view.azimuth += turn[0];
    view.elevation = Math.min(1.4, Math.max(0.02, view.elevation + turn[1]));
    draw();
  });
}
