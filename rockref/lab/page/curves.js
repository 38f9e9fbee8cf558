"use strict";
// The three rates, measured under modelled, and the contacts, by uPlot: one time axis, one cursor.
const NAMES = ["main X", "transverse Y", "longitudinal Z"];

function makeCurves(host, onTime) {
  const plots = [];
  let run = null;
  let contacts = [];
  let names = [];
  let time = 0;
  let range = [0, 1];

  // Main impacts of the record as lines, the instant of the animation as another.
  function drawMarks(u) {
    const c = u.ctx;
    const line = (t, colour, width, dash) => {
      const x = u.valToPos(t, "x", true);
      if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
      c.save();
      c.beginPath();
      c.setLineDash(dash);
      c.strokeStyle = colour;
      c.lineWidth = width * devicePixelRatio;
      c.moveTo(x, u.bbox.top);
      c.lineTo(x, u.bbox.top + u.bbox.height);
      c.stroke();
      c.restore();
    };
    if (run) for (const t of run.impacts) line(t, colourOf("impact"), 1, [2 * devicePixelRatio, 4 * devicePixelRatio]);
    line(time, colourOf("ink"), 1.2, []);
  }

  function drawContacts(u) {
    const c = u.ctx;
    const rows = names.length || 8;
    const step = u.bbox.height / rows;
    c.save();
    c.beginPath();
    c.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    c.clip();
    contacts.forEach((edges, i) => {
      c.fillStyle = colourOf(i % 8 < 4 ? "contact" : "contact-inner");
      const y = u.bbox.top + (i + 0.16) * step;
      for (let k = 0; k + 1 < edges.length; k += 2) {
        const a = u.valToPos(edges[k], "x", true);
        const b = u.valToPos(edges[k + 1], "x", true);
        if (b < u.bbox.left || a > u.bbox.left + u.bbox.width) continue;
        c.fillRect(a, y, Math.max(b - a, 0.8 * devicePixelRatio), 0.68 * step);
      }
    });
    c.restore();
    c.save();
    c.fillStyle = colourOf("soft");
    c.font = Math.round(Math.min(11 * devicePixelRatio, 0.95 * step)) + "px system-ui, sans-serif";
    c.textAlign = "right";
    c.textBaseline = "middle";
    names.forEach((name, i) => c.fillText(name, u.bbox.left - 6 * devicePixelRatio, u.bbox.top + (i + 0.5) * step));
    c.restore();
    drawMarks(u);
  }

  const ink = () => colourOf("soft");
  const axis = (more) => ({
    stroke: ink,
    grid: { stroke: () => colourOf("line"), width: 1 },
    ticks: { show: false },
    font: "11px system-ui, -apple-system, sans-serif",
    ...more,
  });

  function options(k) {
    const last = k === 3;
    return {
      width: Math.max(200, host.clientWidth),
      height: last ? 128 : k === 0 ? 156 : 120,
      legend: { show: false },
      pxAlign: false,
      padding: [6, 8, 0, 0],
      cursor: { sync: { key: "lab" }, drag: { x: true, y: false, setScale: true }, y: false, points: { show: false } },
      scales: { x: { time: false, range: () => range }, y: { range: last ? [0, 1] : limits } },
      axes: [
        axis({
          size: last ? 22 : 4,
          gap: 3,
          values: last ? undefined : () => [],
          label: last ? "time from the release (s)" : undefined,
          labelSize: 16,
          labelFont: "11px system-ui, sans-serif",
          labelGap: 0,
        }),
        axis({
          size: 58,
          values: last ? () => [] : undefined,
          label: last ? "feet" : NAMES[k],
          labelSize: 18,
          labelFont: "12px system-ui, sans-serif",
          grid: { show: !last, stroke: () => colourOf("line"), width: 1 },
        }),
      ],
      series: last
        ? [{}, {}]
        : [
            {},
            { stroke: () => colourOf("measured"), width: 3, spanGaps: false, points: { show: false } },
            { stroke: () => colourOf("model"), width: 1.5, points: { show: false } },
          ],
      hooks: {
        draw: [last ? drawContacts : drawMarks],
        setSelect: [
          (u) => {
            if (u.select.width > 4)
              zoom(u.posToVal(u.select.left, "x"), u.posToVal(u.select.left + u.select.width, "x"));
          },
        ],
      },
    };
  }

  // Room about both curves of the part that is seen; the measured one decides unless the model is twice as large.
  function limits(u, low, high) {
    if (low === null || !(high > low)) return [-1, 1];
    const margin = 0.07 * (high - low);
    return [low - margin, high + margin];
  }

  for (let k = 0; k < 4; k++) {
    const frame = document.createElement("div");
    host.append(frame);
    const plot = new uPlot(
      options(k),
      k === 3
        ? [
            [0, 1],
            [null, null],
          ]
        : [
            [0, 1],
            [null, null],
            [null, null],
          ],
      frame,
    );
    plots.push(plot);
    plot.over.addEventListener("click", (event) => {
      const box = plot.over.getBoundingClientRect();
      if (!plot.select.width) onTime(plot.posToVal(event.clientX - box.left, "x"));
    });
    plot.over.addEventListener("dblclick", () => zoom(0, run ? run.t[run.samples - 1] : 1));
  }

  function zoom(a, b) {
    if (!(b - a > 0.005)) return;
    range = [a, b];
    plots.forEach((p) => {
      p.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
      p.setScale("x", { min: a, max: b });
    });
  }

  function show(shown, answer, pointNames) {
    run = shown;
    contacts = answer.contacts;
    names = pointNames;
    const seen = answer.rates.length / 3;
    for (let k = 0; k < 3; k++) {
      const model = new Array(run.samples).fill(null);
      for (let i = 0; i < Math.min(seen, run.samples); i++) model[i] = answer.rates[3 * i + k];
      plots[k].setData([run.t, run.axes[k], model], false);
      plots[k].setScale("x", { min: range[0], max: range[1] });
    }
    plots[3].setData(
      [
        [range[0], range[1]],
        [null, null],
      ],
      false,
    );
    plots[3].setScale("x", { min: range[0], max: range[1] });
  }

  function seek(t) {
    time = t;
    plots.forEach((p) => p.redraw(false, false));
  }

  new ResizeObserver(() =>
    plots.forEach((p, k) => {
      if (Math.abs(p.width - host.clientWidth) > 1)
        p.setSize({ width: Math.max(200, host.clientWidth), height: options(k).height });
    }),
  ).observe(host);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () =>
    plots.forEach((p) => p.redraw(true, true)),
  );
  return { show, seek, zoom, plots, range: () => range };
}
