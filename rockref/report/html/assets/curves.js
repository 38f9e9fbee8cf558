"use strict";
// Curves that zoom together: drag to zoom, double-click for the whole run, buttons for named stretches.
(function () {
  function abscissa(x) {
    if (x.values) return x.values;
    return Array.from({ length: x.n }, (_, i) => x.start + i * x.step);
  }

  // A line with fewer, even steps of its own is drawn straight between them.
  function ordinates(line, x) {
    const y = unpack(line.y);
    if (line.y.step === undefined) return y;
    return x.map((v) => {
      const at = (v - line.y.start) / line.y.step;
      const k = Math.floor(at);
      if (k < 0 || k + 1 >= y.length) return null;
      return y[k] + (at - k) * (y[k + 1] - y[k]);
    });
  }

  // One row for each contact point, drawn while it touches.
  function drawStrips(u, panel) {
    const c = u.ctx;
    const row = u.bbox.height / panel.strips.length;
    c.save();
    c.beginPath();
    c.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    c.clip();
    c.fillStyle = panel.colour;
    panel.strips.forEach((strip, k) => {
      const top = u.bbox.top + (k + 0.22) * row;
      for (const [from, to] of strip.on) {
        if (to < u.scales.x.min || from > u.scales.x.max) continue;
        const a = u.valToPos(from, "x", true);
        const b = u.valToPos(to, "x", true);
        c.fillRect(a, top, Math.max(b - a, 0.7), 0.56 * row);
      }
    });
    c.restore();
  }

  function options(panel, data, width, key, last) {
    const strips = panel.strips;
    const axisX = { size: last ? 34 : 6, labelSize: 22, grid: { stroke: "#e7ebef" } };
    if (last) axisX.label = data.xLabel;
    else axisX.values = (u, splits) => splits.map(() => "");
    const axisY = { label: panel.label, labelSize: 22, size: 56, grid: { stroke: "#e7ebef" } };
    if (strips) {
      axisY.splits = () => strips.map((_, k) => strips.length - k - 0.5);
      axisY.values = () => strips.map((s) => s.name);
      axisY.grid = { show: false };
    }
    const series = [abscissaOf(data.xLabel)];
    for (const line of panel.lines || []) series.push(lineOf(line.name, line.colour, line.dash, 1.3));
    if (strips) series.push({ label: "contacts", points: { show: false } });
    return {
      width: width,
      height: panel.height + (last ? 66 : 24),
      legend: { show: !strips, live: true },
      cursor: { sync: { key: key, setSeries: false }, drag: { x: true, y: false, dist: 4 }, points: { size: 5 } },
      scales: { x: { time: false }, y: strips ? { range: () => [0, strips.length] } : {} },
      axes: [axisX, axisY],
      series: series,
      hooks: {
        draw: [(u) => (strips ? drawStrips(u, panel) : undefined), (u) => drawMarks(u, data.marks)],
      },
    };
  }

  function build(figure, index) {
    const data = dataOf(figure);
    const live = figure.querySelector(".live");
    const tools = figure.querySelector(".tools");
    live.hidden = tools.hidden = false;
    figure.querySelector(".static").style.display = "none";
    const x = abscissa(data.x);
    const key = "curves-" + index;
    const whole = [x[0], x[x.length - 1]];
    const plots = data.panels.map((panel, k) => {
      const columns = panel.strips ? [x, new Array(x.length).fill(null)] : [x, ...panel.lines.map((l) => ordinates(l, x))];
      return new uPlot(options(panel, data, live.clientWidth, key, k === data.panels.length - 1), columns, live);
    });
    const show = (from, to) => plots.forEach((p) => p.setScale("x", { min: from, max: to }));
    const range = () => [plots[0].scales.x.min, plots[0].scales.x.max];
    const move = (shift, scale) => {
      const [a, b] = range();
      const half = (0.5 * (b - a)) * scale;
      const middle = 0.5 * (a + b) + shift * (b - a);
      show(Math.max(middle - half, whole[0]), Math.min(middle + half, whole[1]));
    };
    for (const view of [{ name: "whole run", from: whole[0], to: whole[1] }, ...data.views]) {
      tools.append(button(view.name, "show " + view.name, () => show(view.from, view.to)));
    }
    tools.append(button("\u2212", "zoom out", () => move(0, 2)), button("+", "zoom in", () => move(0, 0.5)));
    tools.append(button("\u2190", "earlier", () => move(-0.4, 1)), button("\u2192", "later", () => move(0.4, 1)));
    tools.append(element("span", { class: "note" }, "drag to zoom, double-click for the whole run"));
    new ResizeObserver(() => {
      const width = live.clientWidth;
      if (width && Math.abs(width - plots[0].width) > 2) plots.forEach((p) => p.setSize({ width: width, height: p.height }));
    }).observe(live);
    if (data.open) show(data.open[0], data.open[1]);
    rockref.curves.push({ plots: plots, range: range, show: show });
    figure.dataset.state = "ready";
  }

  document.querySelectorAll("figure.curves").forEach((figure, index) => whenSeen(figure, () => build(figure, index)));
})();
