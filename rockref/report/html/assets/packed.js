"use strict";
// Shared by curves, cards and player: data elements, 16-bit columns, small elements, what all plots have.
const rockref = { curves: [], players: [] };

function dataOf(figure) {
  return JSON.parse(document.getElementById(figure.dataset.source).textContent);
}

// A packed column: base64 of little-endian 16-bit integers that count `unit`; -32768 is a gap.
function unpack(column) {
  const text = atob(column.data);
  const values = new Array(column.n);
  for (let i = 0; i < column.n; i++) {
    let v = text.charCodeAt(2 * i) | (text.charCodeAt(2 * i + 1) << 8);
    if (v > 32767) v -= 65536;
    values[i] = v === -32768 ? null : v * column.unit;
  }
  return values;
}

function element(tag, attributes, text) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) made.setAttribute(name, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

function button(text, label, act) {
  const made = element("button", { type: "button", "aria-label": label }, text);
  made.addEventListener("click", act);
  return made;
}

const IMPACT = "#b42318";

// Vertical lines at the main impacts in a plot of curves.
function drawMarks(u, marks) {
  const c = u.ctx;
  c.save();
  c.setLineDash([]);
  c.strokeStyle = IMPACT;
  c.lineWidth = devicePixelRatio;
  c.globalAlpha = 0.7;
  for (const mark of marks) {
    if (mark < u.scales.x.min || mark > u.scales.x.max) continue;
    const at = Math.round(u.valToPos(mark, "x", true));
    c.beginPath();
    c.moveTo(at, u.bbox.top);
    c.lineTo(at, u.bbox.top + u.bbox.height);
    c.stroke();
  }
  c.restore();
}

// The series of a plot of curves: the abscissa, which its legend names, too, and a line.
const abscissaOf = (name) => ({ label: name, value: (u, v) => (v === null ? "" : v.toFixed(4)) });
const lineOf = (name, colour, dash, width) => ({
  label: name, stroke: colour, dash: dash, width: width, points: { show: false },
  value: (u, v) => (v === null || v === undefined ? "" : v.toFixed(2)),
});

// A figure in a closed fold has no width: it is built when the fold is opened. A link into a fold opens it.
function whenSeen(figure, build) {
  const fold = figure.closest("details:not([open])");
  if (!fold) build();
  else fold.addEventListener("toggle", () => whenSeen(figure, build), { once: true });
}

function openFolds() {
  const place = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const fold = place && place.closest("details:not([open])");
  if (fold) {
    fold.open = true;
    place.scrollIntoView();
  }
}

function listen() {
  window.addEventListener("hashchange", openFolds);
  openFolds();
  window.rockref = rockref;
}
listen();
