"use strict";
// The block as it is drawn: its attitude, where it stands on the plate, its faces.

// Rx(tilt) Ry(roll) Rz(turn)
function rotationOf(tilt, roll, turn) {
  const [ca, sa, cb, sb, cc, sc] = [tilt, roll, turn].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
  return [
    [cb * cc, -cb * sc, sb],
    [ca * sc + sa * sb * cc, ca * cc - sa * sb * sc, -sa * cb],
    [sa * sc - ca * sb * cc, sa * cc + ca * sb * sc, ca * cb],
  ];
}

const turnedBy = (R, p) => R.map((r) => r[0] * p[0] + r[1] * p[1] + r[2] * p[2]);

// The block stands on its lowest points, and these stay where they are on the plate.
function placed(R, points, standing) {
  const at = points.map((p) => turnedBy(R, p));
  const low = Math.min(...at.map((p) => p[2]));
  const shift = [0, 0, -low];
  let sum = 0;
  at.forEach((p, i) => {
    const w = Math.exp(-(p[2] - low) / 0.002);
    sum += w;
    shift[0] += w * (standing[i][0] - p[0]);
    shift[1] += w * (standing[i][1] - p[1]);
  });
  return [shift[0] / sum, shift[1] / sum, shift[2]];
}

// Corners of a face about its middle, one way round.
const SQUARE = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
];

// The six faces of a box seen by a camera (place to right, up, towards the eye), the last three towards the eye.
function facesOf(camera, R, shift, box) {
  const half = box.map((v) => v / 2);
  const corner = (v) => {
    const p = turnedBy(R, [v[0] * half[0], v[1] * half[1], v[2] * half[2]]);
    return camera([p[0] + shift[0], p[1] + shift[1], p[2] + shift[2]]);
  };
  const faces = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      const loop = SQUARE.map(([a, b]) => {
        const v = [0, 0, 0];
        v[axis] = side;
        v[(axis + 1) % 3] = a;
        v[(axis + 2) % 3] = b;
        return corner(v);
      });
      faces.push({ loop, axis, depth: loop.reduce((s, p) => s + p[2], 0) });
    }
  }
  return faces.sort((a, b) => a.depth - b.depth);
}

function outline(c, corners) {
  c.beginPath();
  corners.forEach((p, i) => (i ? c.lineTo(p[0], p[1]) : c.moveTo(p[0], p[1])));
  c.closePath();
}

// The context of a canvas for a drawing of this size in pixels of the page, sharp on a dense screen.
function cleared(canvas, width, height) {
  const dense = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * dense) || canvas.height !== Math.round(height * dense)) {
    canvas.width = Math.round(width * dense);
    canvas.height = Math.round(height * dense);
  }
  const c = canvas.getContext("2d");
  c.setTransform(dense, 0, 0, dense, 0, 0);
  c.clearRect(0, 0, width, height);
  return c;
}
