"use strict";
// The block in motion: the modelled one solid, the measured one as an outline; out-of-plane angles are exaggerated, feet
// glow as hard as they are pressed.
const SPEEDS = [
  ["1/50", 0.02],
  ["1/20", 0.05],
  ["1/5", 0.2],
  ["1", 1],
];
// Frames of 2 ms after which a foot is dark again: contacts of 1.5 ms would not be seen.
const AFTERGLOW = 8;

const colourOf = (name) =>
  getComputedStyle(document.documentElement)
    .getPropertyValue("--" + name)
    .trim();

// Places of the points, as the model's sides and heights say.
function pointsOf(n) {
  const inward = 1 - n.delta_diag / (Math.hypot(n.width, n.depth) / 2);
  const corners = [
    [1, 1],
    [-1, 1],
    [-1, -1],
    [1, -1],
  ].map(([x, y]) => [(x * n.width) / 2, (y * n.depth) / 2]);
  const outer = corners.map(([x, y], i) => [x, y, -n.height / 2 + (n.points === 4 ? 0 : n["delta_long_" + (i + 1)])]);
  return [...outer, ...corners.map(([x, y]) => [x * inward, y * inward, -n.height / 2])];
}

function makeScene(canvas, view) {
  let data = null;

  function project(width, height, size) {
    const [ca, sa, ce, se] = [
      Math.cos(view.azimuth),
      Math.sin(view.azimuth),
      Math.cos(view.elevation),
      Math.sin(view.elevation),
    ];
    const scale = Math.min((0.86 * height) / size, (0.9 * width) / (0.62 * size));
    return (p) => {
      const x = ca * p[0] + sa * p[1];
      const y = -sa * p[0] + ca * p[1];
      // Right, up on the screen, and towards the eye.
      return [0.41 * width + scale * x, 0.91 * height - scale * (ce * p[2] + se * y), ce * -y + se * p[2], scale];
    };
  }

  function drawPlate(c, at, width) {
    const reach = 2.1 * width;
    const disc = Array.from({ length: 60 }, (_, k) =>
      at([reach * Math.cos((k * Math.PI) / 30), reach * Math.sin((k * Math.PI) / 30), 0]),
    );
    const middle = at([0, 0, 0]);
    const glow = c.createRadialGradient(middle[0], middle[1], 0, middle[0], middle[1], reach * middle[3]);
    glow.addColorStop(0, colourOf("plate"));
    glow.addColorStop(1, colourOf("card"));
    outline(c, disc);
    c.fillStyle = glow;
    c.fill();
    c.strokeStyle = colourOf("line");
    c.lineWidth = 1;
    for (let k = -4; k <= 4; k++) {
      const s = (k / 4) * 1.6 * width;
      const e = Math.sqrt(Math.max(0, (1.75 * width) ** 2 - s * s));
      for (const [a, b] of [
        [
          [s, -e, 0],
          [s, e, 0],
        ],
        [
          [-e, s, 0],
          [e, s, 0],
        ],
      ]) {
        const [p, q] = [at(a), at(b)];
        c.beginPath();
        c.moveTo(p[0], p[1]);
        c.lineTo(q[0], q[1]);
        c.stroke();
      }
    }
  }

  function drawShadow(c, at, R, shift, box) {
    // The light comes from above, a little from the left and behind.
    const cast = SQUARE.flatMap(([a, b]) =>
      [-1, 1].map((z) => {
        const p = turnedBy(R, [(a * box[0]) / 2, (b * box[1]) / 2, (z * box[2]) / 2]);
        const height = p[2] + shift[2];
        return at([p[0] + shift[0] + 0.34 * height, p[1] + shift[1] + 0.28 * height, 0]);
      }),
    );
    outline(c, hull(cast));
    c.fillStyle = colourOf("shadow");
    c.fill();
  }

  function drawBlock(c, faces) {
    const shades = [colourOf("face-x"), colourOf("face-y"), colourOf("face-z")];
    c.lineJoin = "round";
    faces.slice(3).forEach((f) => {
      const ys = f.loop.map((p) => p[1]);
      const shade = c.createLinearGradient(0, Math.min(...ys), 0, Math.max(...ys));
      shade.addColorStop(0, shades[f.axis]);
      shade.addColorStop(1, f.axis === 2 ? shades[2] : colourOf("face-low"));
      outline(c, f.loop);
      c.fillStyle = shade;
      c.fill();
      c.strokeStyle = colourOf("edge");
      c.lineWidth = 1.2;
      c.stroke();
    });
  }

  function drawGhost(c, faces) {
    c.setLineDash([5, 4]);
    c.strokeStyle = colourOf("measured");
    c.lineWidth = 1.4;
    faces.slice(3).forEach((f) => {
      outline(c, f.loop);
      c.stroke();
    });
    c.setLineDash([]);
  }

  function glowOf(frame, i) {
    let most = 0;
    for (let back = 0; back < AFTERGLOW && frame - back >= 0; back++) {
      most = Math.max(most, data.loads[data.n * (frame - back) + i] * (1 - back / AFTERGLOW));
    }
    // The square root: half the weight is seen beside an impact of forty times as much.
    return Math.min(1, Math.sqrt(most / (4 * data.weight)));
  }

  function drawFoot(c, x, y, size, glow) {
    const hot = colourOf("contact");
    if (glow > 0.02) {
      const halo = c.createRadialGradient(x, y, 0, x, y, size * (1.2 + 2.2 * glow));
      halo.addColorStop(0, hot);
      halo.addColorStop(1, "transparent");
      c.globalAlpha = 0.35 + 0.5 * glow;
      c.fillStyle = halo;
      c.beginPath();
      c.arc(x, y, size * (1.2 + 2.2 * glow), 0, 2 * Math.PI);
      c.fill();
      c.globalAlpha = 1;
    }
    c.beginPath();
    c.arc(x, y, size, 0, 2 * Math.PI);
    c.fillStyle = glow > 0.02 ? hot : colourOf("card");
    c.fill();
    c.lineWidth = glow > 0.02 ? 2 : 1;
    c.strokeStyle = glow > 0.02 ? hot : colourOf("edge");
    c.stroke();
  }

  // The base seen from above; inner points are drawn apart from the outer ones.
  function drawBase(c, frame, area, spin) {
    const scale = area.size / (1.5 * Math.max(data.box[0], data.box[1]));
    const [cs, sn] = [Math.cos(spin), Math.sin(spin)];
    const place = (x, y) => [area.x + scale * (cs * x - sn * y), area.y - scale * (sn * x + cs * y)];
    const [w, d] = [data.box[0] / 2, data.box[1] / 2];
    outline(c, [place(-w, -d), place(w, -d), place(w, d), place(-w, d)]);
    c.fillStyle = colourOf("face-z");
    c.fill();
    c.strokeStyle = colourOf("edge");
    c.lineWidth = 1;
    c.stroke();
    c.font = "11px system-ui, sans-serif";
    c.textAlign = "center";
    data.points.slice(0, data.n).forEach((p, i) => {
      const [x, y] = i < 4 ? [p[0], p[1]] : [0.52 * Math.sign(p[0]) * w, 0.52 * Math.sign(p[1]) * d];
      const [px, py] = place(x, y);
      drawFoot(c, px, py, 4.5, glowOf(frame, i));
      if (i < 4) {
        const [tx, ty] = place(1.3 * x, 1.3 * y);
        c.fillStyle = colourOf("soft");
        c.fillText(String(i + 1), tx, ty + 4);
      }
    });
    c.fillStyle = colourOf("soft");
    c.fillText("base from above", area.x, area.y + 0.5 * area.size + 14);
  }

  function exaggerated(angles, k) {
    const [tilt, roll, turn] = [angles[3 * k], angles[3 * k + 1], angles[3 * k + 2]];
    let off = turn - data.spin;
    off -= 2 * Math.PI * Math.round(off / (2 * Math.PI));
    return rotationOf(tilt, view.times * roll, data.spin + view.times * off);
  }

  function draw(frame) {
    const [width, height] = [canvas.clientWidth || 320, canvas.clientHeight || 360];
    const c = cleared(canvas, width, height);
    if (!data) return;
    const k = Math.min(Math.max(0, Math.floor(frame)), data.frames - 1);
    const at = project(width, height, data.box[2] * 1.12);
    const still = rotationOf(0, 0, data.spin);
    const standing = data.points.map((p) => turnedBy(still, p));
    const R = exaggerated(data.angles, k);
    const shift = placed(R, data.points, standing);
    drawPlate(c, at, data.box[0]);
    drawShadow(c, at, R, shift, data.box);
    drawBlock(c, facesOf(at, R, shift, data.box));
    if (data.ghost && 3 * k + 2 < data.ghost.length && view.ghost) {
      const G = exaggerated(data.ghost, k);
      drawGhost(c, facesOf(at, G, placed(G, data.points, standing), data.box));
    }
    data.points.slice(0, data.n).forEach((p, i) => {
      const glow = glowOf(k, i);
      if (glow <= 0.02) return;
      const q = turnedBy(R, p);
      const [x, y] = at([q[0] + shift[0], q[1] + shift[1], q[2] + shift[2]]);
      drawFoot(c, x, y, 5, glow);
    });
    const size = Math.min(0.33 * width, 124);
    drawBase(c, k, { x: width - 0.66 * size, y: 0.72 * size, size }, data.spin);
  }

  return {
    draw,
    show: (made) => {
      data = made;
    },
    lit: (frame) => data.points.slice(0, data.n).map((_, i) => glowOf(frame, i) > 0.02),
  };
}

// Convex hull of plane points (Andrew 1979).
function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1) {
        const [a, b] = out.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}
