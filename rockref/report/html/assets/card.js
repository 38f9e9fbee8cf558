"use strict";
// A run measured, before and with an effect: a switch, and a slider of its size through precomputed curves.
(function () {
  function options(data, width, after) {
    const series = [abscissaOf("time (s)"), lineOf("measured", data.colours[0], undefined, 2.2)];
    series.push(lineOf("before", data.colours[1], [6, 3], 1.3));
    if (after) series.push(lineOf(after, data.colours[2], undefined, 1.4));
    return {
      width: width, height: 320, series: series,
      cursor: { drag: { x: true, y: false, dist: 4 }, points: { size: 5 } },
      scales: { x: { time: false } },
      axes: [{ label: "time (s)", labelSize: 22, size: 34 }, { label: "deg/s", labelSize: 22, size: 56 }],
      hooks: { draw: [(u) => drawMarks(u, data.marks)] },
    };
  }

  function build(figure, index) {
    const data = dataOf(figure);
    const live = figure.querySelector(".live");
    const tools = figure.querySelector(".tools");
    const dials = figure.querySelector(".dials");
    live.hidden = tools.hidden = false;
    figure.querySelector(".static").style.display = "none";
    const keys = figure.querySelector(".keys"); // the plot has a legend of its own; on paper this one is shown
    if (keys) keys.classList.add("paper");
    const x = Array.from({ length: data.x.n }, (_, i) => data.x.start + i * data.x.step);
    const measured = data.measured.map(unpack);
    const before = data.before.map(unpack);
    const state = { axis: data.axis, dial: 0, at: data.dials.map((d) => d.optimum), on: true };
    const rates = data.dials.map((d) => d.rates.map(() => null));
    const curve = () => {
      const d = state.dial;
      const k = state.on ? state.at[d] : 0;
      if (!rates[d][k]) rates[d][k] = data.dials[d].rates[k].map(unpack);
      return rates[d][k][state.axis];
    };
    const columns = () => {
      const found = [x, measured[state.axis], before[state.axis]];
      if (data.dials.length) found.push(curve());
      return found;
    };
    const name = data.dials.length ? "with " + data.dials[0].effect : "";
    const plot = new uPlot(options(data, live.clientWidth || 320, name), columns(), live);
    const show = (from, to) => plot.setScale("x", { min: from, max: to });
    const draw = () => {
      const range = [plot.scales.x.min, plot.scales.x.max];
      plot.setData(columns(), false);
      show(range[0], range[1]);
    };
    show(data.view[0], data.view[1]);

    const axes = data.axes.map((text, axis) =>
      button(text, "show the rate about the " + text, () => {
        state.axis = axis;
        axes.forEach((b, k) => b.setAttribute("aria-pressed", String(k === axis)));
        draw();
      })
    );
    axes.forEach((b, k) => b.setAttribute("aria-pressed", String(k === state.axis)));
    tools.append(...axes);
    tools.append(button("where it shows", "show where the difference shows", () => show(data.view[0], data.view[1])));
    tools.append(button("whole stretch", "show the whole stretch", () => show(x[0], x[x.length - 1])));

    data.dials.forEach((d, which) => {
      const group = element("div", { class: "dial" });
      const toggle = element("input", { type: "checkbox", role: "switch", id: `switch-${index}-${which}` });
      toggle.checked = true;
      const label = element("label", { for: toggle.id }, d.effect);
      const slider = element("input", {
        type: "range", min: 0, max: d.sizes.length - 1, step: 1, "aria-label": "size of " + d.effect,
      });
      slider.value = d.optimum;
      const said = element("output", { "aria-live": "polite" });
      const tell = () => {
        const k = toggle.checked ? state.at[which] : 0;
        const best = k === d.optimum ? " (as found)" : k === 0 ? " (off)" : "";
        said.textContent = `${d.sizes[k]}${best}: on its own off by ${d.errors[k].toPrecision(2)} deg/s RMS here, ${data.error.toPrecision(2)} without`;
        slider.setAttribute("aria-valuetext", said.textContent);
      };
      const act = () => {
        state.dial = which;
        state.on = toggle.checked;
        if (data.dials.length > 1) plot.setSeries(3, { show: true });
        tell();
        draw();
      };
      toggle.addEventListener("change", act);
      slider.addEventListener("input", () => {
        state.at[which] = Number(slider.value);
        toggle.checked = true;
        act();
      });
      group.append(toggle, label, slider, said);
      dials.append(group);
      tell();
    });
    dials.hidden = !data.dials.length;
    new ResizeObserver(() => {
      const width = live.clientWidth;
      if (width && Math.abs(width - plot.width) > 2) plot.setSize({ width: width, height: plot.height });
    }).observe(live);
    rockref.cards = [...(rockref.cards || []), { plot: plot, state: state, curve: curve }];
    figure.dataset.state = "ready";
  }

  document.querySelectorAll("figure.trial").forEach(build);
})();
