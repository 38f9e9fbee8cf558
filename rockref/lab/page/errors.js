"use strict";
// The error by stretch and axis as a table whose cells hold bars: noise and run-to-run spread are lines across them.
const LEAST_BAR = 0.02;
const MOST_BAR = 60;

// Share of a bar's length, on a logarithmic scale from 0.02 to 60 deg/s.
const share = (v) => Math.min(1, Math.max(0, Math.log(v / LEAST_BAR) / Math.log(MOST_BAR / LEAST_BAR)));
const short = (v) => (v >= 10 ? v.toFixed(1) : v >= 1 ? v.toFixed(2) : v.toFixed(3));

function makeErrors(table) {
  const cells = [];
  const body = table.querySelector("tbody");
  AXES.forEach((axis) => {
    const row = element("tr");
    row.append(element("th", { scope: "row" }, axis));
    cells.push(
      STRETCHES.map(() => {
        const cell = element("td");
        const number = element("span", { class: "number" });
        const bar = element("span", { class: "bar", "aria-hidden": "true" });
        const fill = element("span", { class: "fill" });
        const noise = element("span", { class: "mark noise", title: "noise" });
        const spread = element("span", { class: "mark spread", title: "spread between repeated runs" });
        bar.append(fill, noise, spread);
        cell.append(number, bar);
        row.append(cell);
        return { cell, number, fill, noise, spread };
      }),
    );
    body.append(row);
  });

  function show(run, errors) {
    errors.forEach((row, stretch) =>
      row.forEach((value, axis) => {
        const { cell, number, fill, noise, spread } = cells[axis][stretch];
        const known = Number.isFinite(value);
        number.textContent = known ? short(value) : "–";
        fill.style.width = known ? 100 * share(value) + "%" : "0";
        noise.style.left = 100 * share(run.noise[axis]) + "%";
        const between = run.spread && run.spread[stretch][axis];
        spread.hidden = !between;
        if (between) spread.style.left = 100 * share(between) + "%";
        cell.classList.toggle("good", known && value <= 1.5 * Math.max(run.noise[axis], between || 0));
      }),
    );
  }
  return { show };
}
