// The eight-point rocking block in JavaScript, as a backend that rockref can judge: one JSON object a line, in and out.
//
//     rockref conform exe node backend.js              no packages are needed, only Node.js
//     rockref conform exe node backend.js --mistake    a twin with one wrong line: see what the judge says
//
// One function per rule; the rule's id stands at its line. SI units. Numbers are doubles, and JSON keeps all their bits.
"use strict";
const MISTAKE = process.argv.includes("--mistake");

// -- vectors of three numbers, matrices of three rows -------------------------------------------------------------

const add = (a, b, t = 1) => a.map((x, i) => x + t * b[i]); // a + t b
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const apply = (A, b) => A.map((row) => dot(row, b));
const transposed = (A) => A[0].map((_, j) => A.map((row) => row[j]));
const product = (A, B) => A.map((row) => transposed(B).map((column) => dot(row, column)));
const plus = (A, B) => A.map((row, i) => add(row, B[i]));
const zeros = (n) => Array(n).fill(0);

function inverse(A) {
  const c = [0, 1, 2].map((i) => cross(A[(i + 1) % 3], A[(i + 2) % 3]));
  return transposed(c.map((row) => row.map((x) => x / dot(A[0], c[0]))));
}

// -- what follows from the parameters -----------------------------------------------------------------------------

function derived(q) {
  const { mass, width, depth, height } = q;
  const J = [depth ** 2 + height ** 2, width ** 2 + height ** 2, width ** 2 + depth ** 2].map((s) => (mass * s) / 12); // G1
  const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([i, j]) => [(i * width) / 2, (j * depth) / 2]);
  const inwards = 1 - q.delta_diag / (Math.hypot(width, depth) / 2);
  const external = corners.map(([x, y], i) => [x, y, q.delta_long[i] - height / 2]); // G2
  const internal = corners.map(([x, y]) => [x * inwards, y * inwards, -height / 2]);
  const each = (ext, int) => [...Array(4).fill(ext), ...Array(4).fill(int)];
  const C = (K) => each(q.beta_ext, q.beta_int).map((beta) => 2 * beta * Math.sqrt(K * mass)); // P2 (3.8), P3 (3.9)
  const mu = each(q.mu_ext, q.mu_int);
  return {
    inertia: J.map((j, i) => zeros(3).map((_, k) => (i === k ? j : 0))), P: [...external, ...internal],
    K_N: Array(8).fill(q.K_N), K_T: Array(8).fill(q.K_T), C_N: C(q.K_N), C_T: C(q.K_T), mu_0: mu, mu, // P1 (3.7)
  };
}

// R1: Lambda = exp(-theta_0 X) exp(phi Y); phi such that the lowest points with x > 0 and x < 0 bear half the weight.
function release(q) {
  const turned = (phi) => product(exponential([-q.theta_0, 0, 0]), exponential([0, phi, 0]));
  const height = (i, phi) => dot(turned(phi)[2], q.P[i]);
  const lowest = (side) => q.P.map((_, i) => i).filter((i) => q.P[i][0] * side > 0).reduce((i, j) => (height(j, 0) < height(i, 0) ? j : i));
  const [i, j] = [lowest(1), lowest(-1)], depth = q.K_N.map((K) => (q.mass * q.g) / 2 / K);
  let phi = 0;
  for (let k = 0; k < 20; k++) { // Newton; d(Lambda p)/d phi = Lambda (Y x p)
    const gap = height(i, phi) - height(j, phi) + depth[i] - depth[j];
    phi -= gap / dot(turned(phi)[2], cross([0, 1, 0], add(q.P[i], q.P[j], -1)));
  }
  return { x: [0, 0, -depth[i] - height(i, phi)], Lambda: turned(phi) };
}

// -- one contact point --------------------------------------------------------------------------------------------

function kinematics({ x, Lambda, v, W, P }) { // K1
  const omega = apply(Lambda, W), r = P.map((p) => apply(Lambda, p)), u = r.map((a) => add(x, a));
  const rate = r.map((a) => add(v, cross(omega, a)));
  return { r, u, xi: u.map((a) => -a[2]), xi_rate: rate.map((a) => -a[2]), v_slide: rate.map((a) => a.slice(0, 2)) };
}

function contact_law(q) {
  const { xi, xi_rate, u_t, v_slide, K_N, C_N, K_T, C_T, mu_0, mu } = q;
  if (xi < 0) return { F_N: 0, F_T: [0, 0], s: u_t, touching: false, sliding: false }; // N2 (3.5b), T5: an open foot
  const F_N = Math.max(K_N * xi + C_N * xi_rate, 0); // N1 (3.5a)
  let s = q.anchored ? q.s : u_t; // T5
  let F_T = [0, 1].map((i) => -K_T * (u_t[i] - s[i]) - C_T * v_slide[i]); // T1
  const trace = { s_trial: s, F_trial: F_T, threshold: (q.anchored && q.sliding ? mu : mu_0) * F_N }; // T6
  const size = Math.hypot(...F_T), sliding = size > trace.threshold; // T2 (3.6a)
  if (sliding) {
    const limit = mu * F_N;
    F_T = F_T.map((f) => (MISTAKE ? Math.min(Math.max(f, -limit), limit) : (limit / size) * f)); // T3 (3.6b)
    s = [0, 1].map((i) => u_t[i] + (F_T[i] + C_T * v_slide[i]) / K_T); // T4
  }
  return { F_N, F_T, s, touching: true, sliding, trace };
}

// -- the body -----------------------------------------------------------------------------------------------------

function assemble({ Lambda, r, F, mass, g }) {
  const force = F.reduce((sum, f) => add(sum, f), [0, 0, -mass * g]); // A1
  const moment = r.reduce((sum, a, i) => add(sum, cross(a, F[i])), zeros(3)); // A2
  return { force, moment, T: apply(transposed(Lambda), moment) }; // A3
}

function lessIdentity([x, y, z]) { // exp(Theta^) - I, Rodrigues
  const H = [[0, -z, y], [z, 0, -x], [-y, x, 0]], q = Math.sqrt(x * x + y * y + z * z);
  if (q === 0) return H;
  const second = 2 * (Math.sin(q / 2) / q) ** 2, HH = product(H, H);
  return H.map((row, i) => row.map((h, j) => (Math.sin(q) / q) * h + second * HH[i][j]));
}
const exponential = (Theta) => plus(lessIdentity(Theta), [[1, 0, 0], [0, 1, 0], [0, 0, 1]]);

function firstHalf({ x, v, Lambda, W, a, T, h, inertia: J }) {
  const A = apply(inverse(J), add(T, cross(W, apply(J, W)), -1));
  const Theta = add(zeros(3).map((_, i) => h * W[i]), A, (h * h) / 2); // I2
  const E = lessIdentity(Theta);
  return {
    x: x.map((p, i) => p + h * v[i] + ((h * h) / 2) * a[i]), Theta, Lambda: plus(Lambda, product(Lambda, E)), // I1, I3
    v_predicted: add(v, a, h), W_predicted: add(W, A, h), E, // S1
  };
}

function secondHalf({ v, W, a, T, a_next, T_next, h, inertia: J }, E) {
  const half = add(apply(J, W), T, h / 2);
  const gain = add(add(apply(transposed(E), half), T, h / 2), T_next, h / 2); // I5: what J W gains
  return { v: v.map((p, i) => p + (h / 2) * (a[i] + a_next[i])), W: add(W, apply(inverse(J), gain)) }; // I4
}

function integrate(q) {
  const { E, ...half } = firstHalf(q);
  return { ...half, ...secondHalf(q, E) };
}

// All points at one pose: a, T, F, and what the feet remember.
function evaluate(q, memory, pose) {
  const k = kinematics({ ...pose, P: q.P });
  const feet = k.xi.map((xi, i) => {
    const made = Object.fromEntries(["K_N", "C_N", "K_T", "C_T", "mu_0", "mu"].map((name) => [name, q[name][i]]));
    const kept = { s: memory.s[i], anchored: memory.anchored[i], sliding: memory.sliding[i] };
    return contact_law({ xi, xi_rate: k.xi_rate[i], u_t: k.u[i].slice(0, 2), v_slide: k.v_slide[i], ...kept, ...made });
  });
  const F = feet.map((c) => [...c.F_T, c.F_N]);
  const { force, T } = assemble({ Lambda: pose.Lambda, r: k.r, F, mass: q.mass, g: q.g });
  const kept = { s: feet.map((c) => c.s), anchored: feet.map((c) => c.touching), sliding: feet.map((c) => c.sliding) };
  return { a: force.map((f) => f / q.mass), T, F, ...kept };
}

// The start: its own a, T, F where it brings them, or else the first evaluation.
const started = (q) => (q.a ? q : { ...q, ...evaluate(q, q, q) });

function advanced(q, state) {
  const now = { ...state, h: q.step, inertia: q.inertia }, { E, ...half } = firstHalf(now);
  const pose = { x: half.x, Lambda: half.Lambda };
  const next = evaluate(q, state, { ...pose, v: half.v_predicted, W: half.W_predicted });
  return { ...state, ...pose, ...next, ...secondHalf({ ...now, a_next: next.a, T_next: next.T }, E) };
}

const step = (q) => advanced(q, started(q));

function simulate(q) {
  const last = Math.floor(q.duration / q.step + 1e-9), rows = Math.floor(last * q.step * q.output_rate + 1e-9) + 1;
  const out = { t: [], W: [], x: [], Lambda: [], F: [], anchored: [] };
  let state = started(q), done = 0;
  for (let i = 0; i < rows; i++) {
    const wanted = Math.round(i / (q.output_rate * q.step)); // S2: the nearest step
    for (; done < wanted; done++) state = advanced(q, state);
    out.t.push(done * q.step);
    for (const key of ["W", "x", "Lambda", "F", "anchored"]) out[key].push(state[key]);
  }
  return out;
}

const channel = ({ W }) => ({ crv_deg_s: W.map((row) => row.map((w) => (180 * w) / Math.PI)) }); // M1
const rotate = ({ Theta }) => ({ Lambda: exponential(Theta) });

// -- the conversation ---------------------------------------------------------------------------------------------

const pieces = { simulate, step, derived, release, kinematics, contact_law, assemble, rotate, integrate, channel };
const facts = { protocol: 1, name: "tutorial", version: "1", language: "JavaScript", precision: "float64" };

function answer(request) {
  if (request.cmd === "start") return { ...facts, capabilities: Object.keys(pieces) };
  if (!Object.hasOwn(pieces, request.piece)) return { id: request.id, error: "no such piece" };
  return { id: request.id, out: pieces[request.piece](request.in) };
}

require("readline").createInterface({ input: process.stdin }).on("line", (line) => {
  const request = JSON.parse(line);
  if (request.cmd === "stop") process.exit(0);
  process.stdout.write(JSON.stringify(answer(request)) + "\n");
});
