"use strict";
(() => {
  const given = JSON.parse(document.getElementById("states").textContent);
  const { blocks, frames, rate, corners, pitch, columns, table } = given;
  const canvas = document.getElementById("picture"), pen = canvas.getContext("2d");
  const play = document.getElementById("play"), slider = document.getElementById("time"), speed = document.getElementById("speed");
  const drift = document.getElementById("drift"), told = document.getElementById("told");
  const last = (frames - 1) / rate;
  let time = 0, running = false, before = 0;

  // Numbers of seven bits a byte, the low ones first; even ones stand for n/2, odd ones for -(n + 1)/2; each is the change since the last frame.
  const unpacked = (text, unit) => {
    const bytes = atob(text), found = new Float64Array(frames * blocks);
    let at = 0;
    for (let k = 0; k < found.length; k++) {
      let number = 0, weight = 1, byte = 0;
      do {
        byte = bytes.charCodeAt(at++);
        number += (byte & 127) * weight;
        weight *= 128;
      } while (byte > 127);
      found[k] = (number % 2 ? -(number + 1) / 2 : number / 2) + (k < blocks ? 0 : found[k - blocks]);
    }
    return found.map((number) => number * unit);
  };
  const X = unpacked(given.X, given.length), Y = unpacked(given.Y, given.length), theta = unpacked(given.theta, given.angle);
  let widest = 0;
  for (const x of X) widest = Math.max(widest, Math.abs(x));

  const rows = Math.ceil(blocks / columns);
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // Between two frames, blocks are drawn on the straight line from one to the other.
  const states = () => {
    const place = Math.min(time * rate, frames - 1), k = Math.min(Math.floor(place), Math.max(frames - 2, 0)), part = place - k;
    const next = Math.min(k + 1, frames - 1);
    const between = (list, i) => list[k * blocks + i] + part * (list[next * blocks + i] - list[k * blocks + i]);
    return Array.from({ length: blocks }, (_, i) => ({ x: between(X, i), y: between(Y, i), angle: between(theta, i) }));
  };
  // Angles at which a block has its centre above a corner, and whether it falls from below each on a lowest face.
  const lies = (block) => {
    const turn = 2 * Math.PI, rest = block.angle - turn * Math.floor(block.angle / turn + 0.5);
    return given.lies[given.sides.filter((angle) => angle <= rest).length % given.sides.length];
  };

  const draw = () => {
    const shown = states(), aside = drift.checked ? widest : 0;
    const wide = (columns + 0.2) * pitch + 2 * aside, high = (rows + 0.15) * pitch;
    const box = Math.max(canvas.parentElement.clientWidth, 200), width = Math.min(box, 736), scale = width / wide, dots = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * dots);
    canvas.height = Math.round(scale * high * dots);
    pen.setTransform(dots * scale, 0, 0, -dots * scale, dots * scale * (aside + 0.6 * pitch), dots * scale * (high - 0.1 * pitch));
    const colours = { table: colour("--line"), upright: colour("--upright"), lying: colour("--lying"), inside: colour("--lying-in") };
    const swing = (sines) => sines.reduce((sum, [size, hertz, phase]) => sum + size * Math.sin(2 * Math.PI * hertz * time + phase), 0);
    const at = Math.min(time * rate, frames - 1), k = Math.min(Math.floor(at), Math.max(frames - 2, 0));
    const recorded = (path) => path[k] + (at - k) * (path[Math.min(k + 1, frames - 1)] - path[k]);
    const place = table.recorded ? recorded : swing, across = place(table.x), up = place(table.y);
    pen.lineWidth = 1 / scale;
    pen.strokeStyle = colours.table;
    pen.beginPath();
    for (let row = 0; row < rows; row++) {
      const end = Math.min(columns, blocks - columns * row) - 0.45;
      pen.moveTo(across - 0.55 * pitch - aside, row * pitch + up);
      pen.lineTo(across + end * pitch + aside, row * pitch + up);
    }
    pen.stroke();
    pen.lineWidth = 1.6 / scale;
    let lying = 0;
    // From the back row to the front.
    for (let i = blocks - 1; i >= 0; i--) {
      const block = shown[i], down = lies(block), c = Math.cos(block.angle), s = Math.sin(block.angle);
      lying += down;
      const x = (i % columns) * pitch + (drift.checked ? block.x : 0), y = Math.floor(i / columns) * pitch + block.y;
      pen.beginPath();
      for (const [p, q] of corners) pen.lineTo(x + p * c - q * s, y + p * s + q * c);
      pen.closePath();
      pen.fillStyle = down ? colours.inside : colours.upright;
      pen.strokeStyle = down ? colours.lying : colours.upright;
      pen.fill();
      pen.stroke();
    }
    slider.value = time;
    const words = `${time.toFixed(2)} s: ${blocks - lying} of ${blocks} ${given.ways[0]}, ${lying} ${given.ways[1]}`;
    slider.setAttribute("aria-valuetext", words);
    told.textContent = words;
  };

  const tell = () => {
    play.textContent = running ? "Pause" : "Play";
    told.setAttribute("aria-live", running ? "off" : "polite");
  };
  const tick = (now) => {
    if (!running) return;
    time += Math.min(Math.max(now - before, 0), 100) / 1000 * Number(speed.value);
    before = now;
    if (time >= last) {
      time = last;
      running = false;
      tell();
    }
    draw();
    requestAnimationFrame(tick);
  };
  const start = () => {
    if (time >= last) time = 0;
    running = true;
    before = performance.now();
    tell();
    requestAnimationFrame(tick);
  };
  const stop = () => {
    running = false;
    tell();
    draw();
  };
  const go = (to) => {
    time = Math.min(Math.max(to, 0), last);
    stop();
  };

  play.addEventListener("click", () => (running ? stop() : start()));
  slider.addEventListener("input", () => go(Number(slider.value)));
  drift.addEventListener("change", draw);
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select")) return;
    const steps = { ArrowLeft: -1, ArrowRight: 1, PageDown: -rate / 4, PageUp: rate / 4 };
    if (event.key === " " && !event.target.closest("button, input[type=checkbox]")) play.click();
    else if (event.key in steps) go((Math.round(time * rate) + steps[event.key]) / rate);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(last);
    else return;
    event.preventDefault();
  });
  addEventListener("resize", draw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);

  document.getElementById("controls").hidden = false;
  tell();
  draw();
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) start();
})();
