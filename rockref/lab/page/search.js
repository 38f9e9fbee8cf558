"use strict";
// Find it yourself: the fit, the ranking of effects, the mystery.
function wireSearch(at) {
  const { byId, state, worker, pack } = at;
  const say = (text) => {
    byId("progress").textContent = text;
  };
  let running = false;

  function busy(on) {
    running = on;
    for (const id of ["fit", "rank", "hide"]) byId(id).disabled = on;
    byId("stop").hidden = !on;
    byId("trace").hidden = false;
  }

  // Steps of the fit as bars that fall: the mean robust loss, 0.945 for white noise.
  function trace(losses) {
    const host = byId("trace");
    host.textContent = "";
    const most = Math.max(...losses, 2);
    losses.forEach((loss, k) => {
      const bar = element("span", { title: "step " + k + ": " + loss.toFixed(2) });
      bar.style.height = Math.max(2, (100 * Math.log(1 + loss)) / Math.log(1 + most)) + "%";
      host.append(bar);
    });
  }

  lab.fit = async () => {
    busy(true);
    const losses = [];
    const before = state.copy();
    try {
      const found = await worker.send({ kind: "fit", ...fitProblem(pack, state, lab.experiment) }, (news) => {
        losses.push(news.loss);
        trace(losses);
        say(
          "Fitting, " +
            news.stage +
            ", step " +
            news.step +
            ": mean loss " +
            news.loss.toFixed(2) +
            " (white noise: 0.95)",
        );
        at.apply(news.model);
      });
      at.apply(found.model);
      state.commit(before);
      at.changed();
      at.showAll();
      await at.update(true);
      const words =
        found.loss < 1.1
          ? "The record is explained to its noise."
          : "Something is missing: white noise would leave 0.95.";
      say("Fitted. Mean loss " + found.loss.toFixed(2) + ". " + words);
      lab.loss = found.loss;
    } catch (error) {
      say(String(error.message) === "stopped" ? "Stopped." : "The fit failed: " + error.message);
      if (String(error.message) !== "stopped") throw error;
    } finally {
      busy(false);
    }
  };

  function rankRow(row, found) {
    const item = element("li");
    const fall = (100 * (found.plain - row.objective)) / found.plain;
    const button = element("button", { type: "button", class: "ranked" });
    button.append(
      element("span", { class: "rank-name" }, plainName(row.id)),
      element(
        "span",
        { class: "rank-fall" },
        (fall > 0 ? "−" : "+") + Math.abs(fall).toFixed(fall > 10 ? 0 : 1) + " %",
      ),
    );
    const bar = element("span", { class: "rank-bar", "aria-hidden": "true" });
    bar.style.width = Math.max(0, Math.min(100, fall)) + "%";
    button.append(bar);
    button.setAttribute(
      "aria-label",
      plainName(row.id) + ": one step takes " + fall.toFixed(1) + " percent of the objective; switch it on",
    );
    button.addEventListener("click", () => {
      const before = state.copy();
      at.apply(row.model);
      state.commit(before);
      at.changed();
      at.showAll();
      at.update(true);
      byId("effects")
        .querySelector('[data-effect="' + row.id + '"]')
        .scrollIntoView({ block: "nearest" });
    });
    item.append(button);
    return item;
  }

  lab.rank = async () => {
    busy(true);
    byId("ranking").textContent = "";
    try {
      const problem = { ...fitProblem(pack, state, lab.experiment), candidates: candidates(state) };
      const found = await worker.send({ kind: "rank", ...problem }, (news) =>
        say("Trying " + plainName(news.id) + ", " + Math.round(100 * news.share) + " %"),
      );
      lab.ranking = found;
      found.rows.slice(0, 8).forEach((row) => byId("ranking").append(rankRow(row, found)));
      const best = found.rows[0];
      const fall = (found.plain - best.objective) / found.plain;
      say(
        fall > 0.02
          ? "One shared step: " + plainName(best.id) + " helps most. Switch it on, then fit."
          : "No effect takes more than 2 % in one step.",
      );
    } catch (error) {
      say(String(error.message) === "stopped" ? "Stopped." : "The ranking failed: " + error.message);
      if (String(error.message) !== "stopped") throw error;
    } finally {
      busy(false);
    }
  };

  lab.mystery = async (seed, fresh = true) => {
    lab.seed = seed;
    byId("seed").value = seed;
    const hidden = await worker.send({ kind: "hide", seed });
    if (fresh) {
      state.now = { ...state.now, releases: {}, run: 0 };
      state.reset();
      state.past = [];
    }
    byId("guess-box").hidden = false;
    byId("verdict").textContent = "";
    byId("ranking").textContent = "";
    await at.useExperiment(hidden);
    say("An effect is hidden in these runs. Rank, switch on, fit; then say which it is.");
  };

  const guess = byId("guess");
  guess.append(element("option", { value: "" }, "choose an effect"));
  for (const id of Object.keys(state.catalogue)) guess.append(element("option", { value: id }, plainName(id)));
  guess.addEventListener("change", async () => {
    if (!guess.value) return;
    const secret = await worker.send({ kind: "reveal" });
    byId("verdict").textContent = judged(secret, guess.value, state);
    lab.secret = secret;
  });

  byId("fit").addEventListener("click", () => lab.fit());
  byId("rank").addEventListener("click", () => lab.rank());
  lab.home = () => {
    lab.seed = 0;
    byId("guess-box").hidden = true;
    state.now.releases = {};
    state.reset();
    return at.useExperiment(pack.experiment);
  };
  byId("home").addEventListener("click", () => lab.home());
  byId("hide").addEventListener("click", () =>
    lab.mystery(Math.min(999999, Math.max(1, Math.floor(Number(byId("seed").value)) || 1))),
  );
  byId("stop").addEventListener("click", async () => {
    await worker.stop();
    if (lab.seed) await worker.send({ kind: "hide", seed: lab.seed });
    at.update(true);
  });
}

// How well a hidden effect was found: its name, and its numbers where it is switched on.
function judged(secret, id, state) {
  if (id !== secret.effect.id) return "No: it is not " + plainName(id) + ". Look on, or choose again.";
  const found = state.acting()[id];
  if (!found) return "Yes, " + plainName(id) + ". Switch it on and fit to learn its size.";
  const effect = state.catalogue[id];
  const words = effect.quantities
    .filter(
      (q) =>
        effect.switches.includes(q.name) &&
        secret.effect.values[q.name] !== q.absent &&
        secret.effect.values[q.name] !== null,
    )
    .map(
      (q) =>
        q.name +
        " " +
        withUnit(found[q.name], q.unit) +
        " (hidden: " +
        withUnit(secret.effect.values[q.name], q.unit) +
        ")",
    );
  return "Yes, " + plainName(id) + ": " + words.join(", ") + ".";
}
