"use strict";
// The grains as an animation, and a marker on each curve at the time shown. No library.
(function () {
  const element = (id) => document.getElementById(id);
  const facts = JSON.parse(element("facts").textContent);
  const last = 65534, absent = 65535;  // 16-bit places, as in grains.py

  // --- curves ---------------------------------------------------------------------------------

  const curves = Array.from(document.querySelectorAll(".plot")).map(readCurve);

  function readCurve(figure) {  // places are those of the SVG, values follow from the axes' ends
    const svg = figure.querySelector("svg"), frame = svg.querySelector(".frame");
    const side = (name) => Number(frame.getAttribute(name)), end = (name) => Number(svg.dataset[name]);
    return {
      svg, now: svg.querySelector(".now"), output: figure.querySelector("output"), log: "log" in svg.dataset,
      t0: end("t0"), t1: end("t1"), y0: end("y0"), y1: end("y1"),
      left: side("x"), width: side("width"), bottom: side("y") + side("height"), height: side("height"),
      series: Array.from(svg.querySelectorAll(".curve"), (path) => ({
        dot: path.nextElementSibling,
        points: path.getAttribute("d").match(/[\d.]+ [\d.]+/g).map((pair) => pair.split(" ").map(Number)),
      })),
    };
  }

  function nearest(points, x) {  // the point of a curve nearest to the place x
    let low = 0, high = points.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (points[middle][0] < x) low = middle; else high = middle;
    }
    return Math.abs(points[low][0] - x) <= Math.abs(points[high][0] - x) ? points[low] : points[high];
  }

  function readable(value) {
    const size = Math.abs(value);
    const short = size < 1e5 && (size >= 1e-3 || size === 0);
    return (short ? String(Number(value.toPrecision(4))) : value.toExponential(2)).replace(/-/g, "−");
  }

  function markCurve(c, t) {
    const x = c.left + (t - c.t0) / (c.t1 - c.t0) * c.width;
    const inside = x >= c.left - 0.5 && x <= c.left + c.width + 0.5;
    c.now.style.visibility = inside ? "visible" : "hidden";
    c.now.setAttribute("x1", x);
    c.now.setAttribute("x2", x);
    const said = c.series.map(({ dot, points }) => {
      const [px, py] = nearest(points, x);
      const near = inside && Math.abs(px - x) < Math.max(4, 0.6 * c.width / points.length);
      dot.style.visibility = near ? "visible" : "hidden";
      dot.setAttribute("cx", px);
      dot.setAttribute("cy", py);
      const value = c.y0 + (c.bottom - py) / c.height * (c.y1 - c.y0);
      return near ? readable(c.log ? Math.pow(10, value) : value) : "–";
    });
    c.output.textContent = inside ? said.join(", ") : "";
  }

  function timeUnder(c, event) {
    const box = c.svg.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width * c.svg.viewBox.baseVal.width;
    return c.t0 + Math.min(1, Math.max(0, (x - c.left) / c.width)) * (c.t1 - c.t0);
  }

  // --- the grains' data -----------------------------------------------------------------------

  function decode(text) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0)), view = new DataView(bytes.buffer);
    return Uint16Array.from({ length: bytes.length / 2 }, (_, i) => view.getUint16(2 * i, true));
  }

  const shapes = facts.spheres || [];  // [x, y, z, radius] of the spheres of each kind, of a clump of diameter 1
  const rows = shapes.length > 0 ? 6 : 3;  // of a frame: places, and of clumps three parts of a quaternion

  function rowOf(words, index, row, low, high) {
    const start = facts.n * (1 + rows * index + row);
    return Float32Array.from(words.subarray(start, start + facts.n),
      (q) => q === absent ? NaN : low + q / last * (high - low));
  }

  function frameOf(words, index) {  // x, y, z [m] of all grains; absent ones are nan
    return facts.bounds.map(([low, high], axis) => rowOf(words, index, axis, low, high));
  }

  function spheresOf(words, index, places) {  // x, y, z [m] of the spheres of all grains
    if (shapes.length === 0) return places;
    const turn = [3, 4, 5].map((row) => rowOf(words, index, row, -1, 1)), result = places.map(() => []);
    places[0].forEach((_, grain) => {
      const [a, b, c] = turn.map((part) => part[grain]), w = Math.sqrt(Math.max(0, 1 - a * a - b * b - c * c));
      for (const [x, y, z] of shapeOf(grain)) {
        const [i, j, k] = [2 * (b * z - c * y), 2 * (c * x - a * z), 2 * (a * y - b * x)];
        const arm = [x + w * i + b * k - c * j, y + w * j + c * i - a * k, z + w * k + a * j - b * i];
        arm.forEach((part, axis) => result[axis].push(places[axis][grain] + 2 * radii[grain] * part));
      }
    });
    return result;
  }

  function windowOf(index, follow) {  // [x0, x1, z0, z1] [m]: the channel, or the part with the dune
    const [[xLow, xHigh], , [zLow, zHigh]] = facts.bounds;
    if (!follow) return [xLow, xHigh, zLow, zHigh];
    const [x, z] = facts.window.centres[index], [w, h] = facts.window.size;
    const x0 = Math.min(Math.max(x - w / 2, xLow), xHigh - w);
    const z0 = Math.min(Math.max(z - h / 2, zLow), zHigh - h);
    return [x0, x0 + w, z0, z0 + h];
  }

  // --- drawing; all places in CSS pixels ------------------------------------------------------

  function sized(canvas, height) {  // one canvas pixel a device pixel
    const width = canvas.clientWidth, ratio = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return context;
  }

  // Discs in the given order, those behind first: places across and up, radii, levels of colour.
  function paint(context, order, { across, up, radius, level }) {
    const outline = 0.5 * facts.dMax * radius.scale > 2.5;
    let current = -1;
    const finish = () => {
      if (current < 0) return;
      context.fillStyle = colours[current];
      context.fill();
      if (outline) context.stroke();
    };
    context.lineWidth = 0.6;
    context.strokeStyle = "rgba(0, 0, 0, 0.45)";
    for (const i of order) {
      if (level[i] !== current || outline) {  // one path for neighbours of one colour; outlined ones singly
        finish();
        context.beginPath();
        current = level[i];
      }
      const x = across(i), y = up(i), r = Math.max(0.9, radius.of[i] * radius.scale);
      context.moveTo(x + r, y);
      context.arc(x, y, r, 0, 2 * Math.PI);
    }
    finish();
  }

  function paintBodies(context, kind, across, up) {  // outlines in the plan or in the section
    context.fillStyle = "rgba(218, 218, 218, 0.9)";
    context.strokeStyle = "#4a4a4a";
    context.lineWidth = 1;
    for (const body of facts.bodies || []) {
      for (const outline of body[kind]) {
        context.beginPath();
        for (const [a, b] of outline) context.lineTo(across(a), up(b));
        context.closePath();
        context.fill();
        context.stroke();
      }
    }
  }

  function nameBodies(context, x0, z0, scale) {  // where there are several
    if ((facts.bodies || []).length < 2) return;
    context.textAlign = "center";
    for (const { name, plan } of facts.bodies) {
      const x = plan.flat().map((place) => place[0]), z = plan.flat().map((place) => place[1]);
      const middle = 0.5 * (Math.min(...x) + Math.max(...x));
      if (x.length > 0) context.fillText(name, (middle - x0) * scale, Math.max(12, (Math.min(...z) - z0) * scale - 4));
    }
  }

  function lettering(context) {
    const ink = getComputedStyle(document.documentElement).getPropertyValue("--on-water").trim();
    context.fillStyle = ink;
    context.strokeStyle = ink;
    context.lineWidth = 2;
    context.font = "12px system-ui, sans-serif";
  }

  function stroke(context, x0, y0, x1, y1) {
    context.beginPath();
    context.moveTo(x0, y0);
    context.lineTo(x1, y1);
    context.stroke();
  }

  function scaleBar(context, width, height, scale) {  // a round length below a fifth of the width
    const wanted = 0.22 * width / scale, power = Math.pow(10, Math.floor(Math.log10(wanted)));
    const length = power * [5, 2, 1].find((m) => m * power <= wanted), x = width - 14, y = height - 12;
    stroke(context, x - length * scale, y, x, y);
    context.textAlign = "center";
    context.fillText(Number((1e3 * length).toPrecision(3)) + " mm", x - 0.5 * length * scale, y - 6);
  }

  function flowArrow(context) {
    context.textAlign = "left";
    context.fillText("flow", 12, 20);
    stroke(context, 42, 16, 76, 16);
    context.beginPath();
    context.moveTo(82, 16);
    context.lineTo(72, 11);
    context.lineTo(72, 21);
    context.fill();
  }

  function floorWithPlaces(context, width, height, x0, scale) {  // x in mm along the lower edge
    const wanted = 90 / scale, power = Math.pow(10, Math.floor(Math.log10(wanted)));
    const step = power * [1, 2, 5, 10].find((m) => m * power >= wanted);
    context.fillRect(0, height - 20, width, 1);
    context.textAlign = "center";
    for (let i = Math.ceil(x0 / step); (i * step - x0) * scale < width - 25; i += 1) {
      const x = (i * step - x0) * scale;
      context.fillRect(x - 0.5, height - 20, 1, 5);
      if (x > 12) context.fillText(Number((1e3 * i * step).toPrecision(4)), x, height - 3);
    }
    context.textAlign = "right";
    context.fillText("x (mm)", width - 6, 15);
  }

  function drawFromAbove(canvas, inView, [, y, z], [x0, x1, z0, z1], grains) {
    const width = canvas.clientWidth, scale = width / (x1 - x0), height = Math.round((z1 - z0) * scale);
    const context = sized(canvas, height);
    paintBodies(context, "plan", (place) => (place - x0) * scale, (place) => (place - z0) * scale);
    paint(context, inView.sort((a, b) => y[a] - y[b]), { ...grains, up: (i) => (z[i] - z0) * scale });
    lettering(context);
    nameBodies(context, x0, z0, scale);
    if (facts.flow) flowArrow(context);
    scaleBar(context, width, height, scale);
  }

  function drawFromSide(canvas, inView, [, y, z], [x0, x1], grains) {
    const width = canvas.clientWidth, scale = width / (x1 - x0);
    const stretch = Math.max(1, Math.min(4, Math.round(60 / (facts.top * scale))));
    const top = Math.max(facts.top, ...(facts.bodies || []).map((body) => Math.min(body.top, 3 * facts.top)));
    const height = Math.round(1.25 * top * scale * stretch) + 40, context = sized(canvas, height);
    paintBodies(context, "section", (x) => (x - x0) * scale, (y) => height - 20 - y * scale * stretch);
    paint(context, inView.sort((a, b) => z[a] - z[b]),
      { ...grains, up: (i) => height - 20 - y[i] * scale * stretch });
    lettering(context);
    floorWithPlaces(context, width, height, x0, scale);
    context.textAlign = "left";
    context.fillText(stretch > 1 ? "from the side, heights × " + stretch : "from the side", 8, 15);
  }

  // --- the player -----------------------------------------------------------------------------

  const words = decode(element("data").textContent);
  const radii = Float32Array.from(words.subarray(0, facts.n), (q) => 0.5 * q / last * facts.dMax);
  const groups = facts.groups || [];
  const colours = groups.length > 0 ? groups.map(({ colour }) => colour) : facts.colours;
  const group = facts.n ? words.subarray(facts.n * (1 + rows * facts.times.length)) : [];  // if there are several
  const shapeOf = (grain) => shapes.length > 1 ? shapes[group[grain]] : shapes[0];
  const grainOf = shapes.length > 0  // of each sphere
    ? Array.from(radii.keys()).flatMap((grain) => shapeOf(grain).map(() => grain)) : Array.from(radii.keys());
  const drawnRadii = shapes.length > 0  // of the spheres
    ? Array.from(radii).flatMap((radius, grain) => shapeOf(grain).map((sphere) => 2 * radius * sphere[3])) : radii;
  let now = 0, timer = null;

  function draw() {
    const whole = frameOf(words, now), places = spheresOf(words, now, whole), [x] = places;
    const view = windowOf(now, element("near").checked);
    const scale = element("top").clientWidth / (view[1] - view[0]);
    const inView = Array.from(x.keys()).filter((i) => x[i] > view[0] && x[i] < view[1]);
    const height = (grain) => Math.floor((whole[1][grain] + radii[grain]) / facts.top * colours.length);
    const level = grainOf.map((grain) => groups.length > 0 ? group[grain]
      : Math.min(colours.length - 1, Math.max(0, height(grain))));
    const grains = { level, radius: { of: drawnRadii, scale }, across: (i) => (x[i] - view[0]) * scale };
    drawFromAbove(element("top"), inView, places, view, grains);
    drawFromSide(element("side"), inView, places, view, grains);
  }

  function show(index) {
    now = Math.min(Math.max(index, 0), facts.times.length - 1);
    const digits = facts.times[facts.times.length - 1] < 1 ? 3 : 2;
    const text = "t = " + facts.times[now].toFixed(digits) + " s";
    element("time").textContent = text;
    element("scrubber").value = now;
    element("scrubber").setAttribute("aria-valuetext", text);
    draw();
    for (const curve of curves) markCurve(curve, facts.times[now]);
  }

  function play(on) {
    clearInterval(timer);
    timer = on ? setInterval(() => show((now + 1) % facts.times.length), 120) : null;
    element("play").textContent = on ? "❚❚" : "▶";
    element("play").setAttribute("aria-label", on ? "pause" : "play");
  }

  function pauseAt(index) {
    play(false);
    show(index);
  }

  function showTime(t) {
    if (!facts.times) {
      for (const curve of curves) markCurve(curve, t);
      return;
    }
    const distance = facts.times.map((time) => Math.abs(time - t));
    const best = distance.indexOf(Math.min(...distance));
    if (best !== now) pauseAt(best);
  }

  function key(event) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const inPlayer = element("player").contains(event.target) && event.target !== element("near");
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (step && event.target !== element("scrubber")) pauseAt(now + step);
    else if (event.key === " " && inPlayer) play(timer === null);
    else return;
    event.preventDefault();
  }

  function startPlayer() {
    element("near").checked = element("top").clientWidth < 600
      || facts.bounds[0][1] - facts.bounds[0][0] > 4 * facts.window.size[0];
    element("near").addEventListener("change", () => show(now));
    element("scrubber").addEventListener("input", () => pauseAt(Number(element("scrubber").value)));
    element("play").addEventListener("click", () => play(timer === null));
    document.addEventListener("keydown", key);
    window.addEventListener("resize", () => show(now));
    window.addEventListener("beforeprint", () => pauseAt(now));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => show(now));
    show(facts.times.length - 1);
  }

  for (const curve of curves) {
    for (const kind of ["pointermove", "pointerdown"]) {
      curve.svg.addEventListener(kind, (event) => showTime(timeUnder(curve, event)));
    }
  }
  if (facts.times) startPlayer();
  else if (curves.length) showTime(curves[0].t1);
})();
