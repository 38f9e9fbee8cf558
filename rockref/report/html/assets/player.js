"use strict";
// The block in motion, drawn from three angles a frame: tilt about X, roll about Y, turn about Z. Out-of-plane angles are
// exaggerated, feet light up while they touch, and the base is drawn from above beside the block.
(function () {
  const SPEEDS = [["1/50", 0.02], ["1/20", 0.05], ["1/5", 0.2], ["1", 1]];
  const TOUCH = "#d55e00";
  const INK = "#1f2328";
  const FACE = ["#dfe5ec", "#cbd4de", "#eef2f6"];
  // A dozen frames after its contact a foot is dark again: contacts of 1.5 ms would not be seen.
  const AFTERGLOW = 6;

  function camera(view, width, height, size) {
    const [ca, sa, ce, se] = [Math.cos(view.azimuth), Math.sin(view.azimuth), Math.cos(view.elevation), Math.sin(view.elevation)];
    const scale = (0.74 * height) / size;
    return (p) => {
      const x = ca * p[0] + sa * p[1];
      const y = -sa * p[0] + ca * p[1];
      // Right, up on the screen, and towards the eye.
      return [0.4 * width + scale * x, 0.9 * height - scale * (ce * p[2] + se * y), ce * -y + se * p[2]];
    };
  }

  function polygon(c, corners, fill, stroke) {
    outline(c, corners);
    if (fill) { c.fillStyle = fill; c.fill(); }
    if (stroke) { c.strokeStyle = stroke; c.stroke(); }
  }

  function drawPlate(c, project, width) {
    c.strokeStyle = "#c2ccd6";
    c.lineWidth = 1;
    for (let k = -3; k <= 3; k++) {
      const s = (k / 3) * 1.6 * width;
      const e = 1.6 * width;
      for (const [a, b] of [[[s, -e, 0], [s, e, 0]], [[-e, s, 0], [e, s, 0]]]) {
        const [p, q] = [project(a), project(b)];
        c.beginPath();
        c.moveTo(p[0], p[1]);
        c.lineTo(q[0], q[1]);
        c.stroke();
      }
    }
  }

  function foot(c, x, y, r, glow, estimated) {
    c.beginPath();
    c.arc(x, y, r, 0, 2 * Math.PI);
    c.fillStyle = "#fff";
    c.fill();
    if (glow > 0 && !estimated) {
      c.globalAlpha = glow;
      c.fillStyle = TOUCH;
      c.fill();
      c.globalAlpha = 1;
    }
    c.lineWidth = estimated && glow > 0 ? 3 : 1;
    c.strokeStyle = glow > 0 ? TOUCH : INK;
    c.stroke();
  }

  // The base seen from above; points closer to one another than a seventh of the width are drawn apart.
  function drawBase(c, data, lit, area, spin, estimated) {
    const scale = area.size / (1.45 * Math.max(data.box[0], data.box[1]));
    const [cs, sn] = [Math.cos(spin), Math.sin(spin)];
    const place = (x, y) => [area.x + scale * (cs * x - sn * y), area.y - scale * (sn * x + cs * y)];
    const [w, d] = [data.box[0] / 2, data.box[1] / 2];
    c.lineWidth = 1;
    polygon(c, [place(-w, -d), place(w, -d), place(w, d), place(-w, d)], "#fff", INK);
    c.font = "10px system-ui, sans-serif";
    c.textAlign = "center";
    data.plan.forEach(([x, y], i) => {
      const [px, py] = place(x, y);
      foot(c, px, py, 5, lit[i], estimated);
      const name = data.points[i].name;
      if (!name.endsWith("int")) {
        const [tx, ty] = place(1.23 * x, 1.23 * y);
        c.fillStyle = INK;
        c.fillText(name.replace("ext", ""), tx, ty + 3);
      }
    });
    c.fillStyle = "#59636e";
    c.fillText("base from above", area.x, area.y + 0.5 * area.size + 12);
  }

  function planOf(data) {
    const least = data.box[0] / 7;
    const plan = [];
    for (const { at } of data.points) {
      const close = plan.some(([x, y]) => Math.hypot(x - at[0], y - at[1]) < least);
      plan.push(close ? [0.68 * at[0], 0.68 * at[1]] : [at[0], at[1]]);
    }
    return plan;
  }

  function build(figure) {
    const data = dataOf(figure);
    const stage = figure.querySelector(".stage");
    const tools = figure.querySelector(".tools");
    figure.querySelector(".static").style.display = "none";
    tools.hidden = false;
    data.plan = planOf(data);
    const points = data.points.map((p) => p.at);
    const state = { frame: 0, playing: false, speed: data.speed || 0.05, times: data.times || 40, azimuth: -2.1, elevation: 0.3 };
    const bodies = data.bodies.map((body) => {
      const frame = element("div");
      const canvas = element("canvas", { role: "img", "aria-label": "block " + body.name });
      frame.append(element("h4", {}, body.name), canvas);
      stage.append(frame);
      return { ...body, canvas: canvas, columns: body.angles.map(unpack), bits: unpack(body.touching) };
    });

    function glow(body, frame) {
      return points.map((_, i) => {
        for (let back = 0; back < AFTERGLOW && frame - back >= 0; back++) {
          if ((body.bits[frame - back] >> i) & 1) return 1 - back / AFTERGLOW;
        }
        return 0;
      });
    }

    function drawBody(body, frame) {
      const canvas = body.canvas;
      const width = canvas.clientWidth || 300;
      const height = Math.round(Math.min(380, Math.max(260, 0.95 * width)));
      canvas.style.height = height + "px";
      const c = cleared(canvas, width, height);
      const [tilt, roll, turn] = body.columns.map((column) => column[frame] || 0);
      const R = rotationOf(tilt, state.times * roll, body.turned + state.times * turn);
      const still = rotationOf(0, 0, body.turned);
      const shift = placed(R, points, points.map((p) => turnedBy(still, p)));
      const project = camera(state, width, height, data.box[2]);
      const lit = glow(body, frame);
      drawPlate(c, project, data.box[0]);
      c.lineWidth = 1;
      facesOf(project, R, shift, data.box).slice(3).forEach((f) => polygon(c, f.loop, FACE[f.axis], INK));
      points.forEach((p, i) => {
        if (lit[i] <= 0) return;
        const q = turnedBy(R, p);
        const [x, y] = project([q[0] + shift[0], q[1] + shift[1], q[2] + shift[2]]);
        foot(c, x, y, 5, lit[i], body.estimated);
      });
      const size = Math.min(0.36 * width, 120);
      drawBase(c, data, lit, { x: width - 0.62 * size, y: 0.62 * size, size: size }, body.turned, body.estimated);
      c.fillStyle = "#59636e";
      c.textAlign = "right";
      const degrees = (v) => ((v * 180) / Math.PI).toFixed(2) + "\u00b0";
      ["tilt " + degrees(tilt), "roll " + degrees(roll), "turn " + degrees(turn)].forEach((text, k) => {
        c.fillText(text, width - 8, height - 36 + 13 * k);
      });
    }

    function draw() {
      const frame = Math.min(Math.floor(state.frame), data.frames - 1);
      bodies.forEach((body) => drawBody(body, frame));
      slider.value = frame;
      const t = (data.start || 0) + frame * data.step;
      const last = data.impacts.filter((at) => at <= t).length;
      clock.textContent = t.toFixed(3) + " s";
      figure.dataset.frame = frame;
      if (data.impacts.length) note.textContent = last ? "after main impact " + last : "before the first main impact";
    }

    let before = 0;
    function tick(now) {
      if (!state.playing) return;
      state.frame += ((before ? now - before : 0) / 1000) * (state.speed / data.step);
      before = now;
      if (state.frame >= data.frames - 1) {
        state.frame = data.frames - 1;
        play(false);
      }
      draw();
      if (state.playing) requestAnimationFrame(tick);
    }

    function play(on) {
      if (on && state.frame >= data.frames - 1) state.frame = 0;
      state.playing = on;
      before = 0;
      toggle.textContent = on ? "pause" : "play";
      toggle.setAttribute("aria-label", on ? "pause" : "play");
      if (on) requestAnimationFrame(tick);
    }

    function seek(frame) {
      state.frame = Math.min(Math.max(frame, 0), data.frames - 1);
      draw();
    }

    const toggle = button("play", "play", () => play(!state.playing));
    const slider = element("input", { type: "range", min: 0, max: data.frames - 1, value: 0, "aria-label": "instant" });
    const clock = element("output");
    const note = element("span", { class: "note" });
    slider.addEventListener("input", () => { play(false); seek(Number(slider.value)); });
    const speed = element("select", { "aria-label": "speed" });
    for (const [text, value] of SPEEDS) speed.append(element("option", { value: value }, text));
    speed.value = state.speed;
    speed.addEventListener("change", () => { state.speed = Number(speed.value); });
    const times = element("input", { type: "range", min: 1, max: 100, value: state.times, "aria-label": "exaggeration of roll and turn" });
    const shown = element("span", {}, "\u00d7" + state.times);
    times.addEventListener("input", () => {
      state.times = Number(times.value);
      shown.textContent = "\u00d7" + state.times;
      draw();
    });
    const speedLabel = element("label", {}, "speed");
    speedLabel.append(speed);
    const timesLabel = element("label", {}, "roll and turn");
    timesLabel.append(times, shown);
    tools.append(
      toggle,
      button("\u2039", "one frame back", () => { play(false); seek(Math.floor(state.frame) - 1); }),
      button("\u203a", "one frame on", () => { play(false); seek(Math.floor(state.frame) + 1); }),
      slider, clock, note, speedLabel, timesLabel
    );
    data.impacts.slice(0, 3).forEach((at, k) => {
      tools.append(button("impact " + (k + 1), "to main impact " + (k + 1), () => { play(false); seek(Math.floor((at - 0.03) / data.step)); }));
    });

    for (const body of bodies) {
      let from = null;
      body.canvas.addEventListener("pointerdown", (e) => { from = [e.clientX, e.clientY]; body.canvas.setPointerCapture(e.pointerId); });
      body.canvas.addEventListener("pointerup", () => { from = null; });
      body.canvas.addEventListener("pointermove", (e) => {
        if (!from) return;
        state.azimuth -= 0.01 * (e.clientX - from[0]);
        state.elevation = Math.min(1.4, Math.max(0.02, state.elevation + 0.01 * (e.clientY - from[1])));
        from = [e.clientX, e.clientY];
        draw();
      });
    }
    new ResizeObserver(() => draw()).observe(stage);
    rockref.players.push({ state: state, seek: seek, play: play, rotation: rotationOf, bodies: bodies });
    draw();
    figure.dataset.state = "ready";
  }

  document.querySelectorAll("figure.player").forEach((figure) => whenSeen(figure, () => build(figure)));
})();
