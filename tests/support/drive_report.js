"use strict";
// drive_report.js REPORT.html: uses the controls of the page about a fake run and stops at the first surprise.
// jsdom is a browser without a screen: sizes are made up, and a canvas only notes what is drawn on it.
const assert = require("assert/strict"), fs = require("fs");
const { JSDOM, VirtualConsole } = require("jsdom");

const drawn = {}, complaints = [];
function addScreen(window) {
  window.matchMedia = () => ({ addEventListener() {} });
  window.HTMLCanvasElement.prototype.getContext = function () {
    const strokes = drawn[this.id] = [];
    return new Proxy({}, {
      get: (_, name) => (...numbers) => strokes.push([name, ...numbers]),
      set: (_, name, value) => strokes.push([name, value]),
    });
  };
  Object.defineProperty(window.HTMLElement.prototype, "clientWidth", { value: 900 });
  Object.defineProperty(window.SVGSVGElement.prototype, "viewBox", { value: { baseVal: { width: 360 } } });
  window.Element.prototype.getBoundingClientRect = () => ({ left: 0, width: 720 });
}

const virtualConsole = new VirtualConsole().on("jsdomError", (error) => complaints.push(error.message));
const { window } = new JSDOM(fs.readFileSync(process.argv[2], "utf8"),
  { runScripts: "dangerously", beforeParse: addScreen, virtualConsole });
const { document, Event, KeyboardEvent, MouseEvent } = window;
const element = (id) => document.getElementById(id), scrubber = element("scrubber");

const state = () => ({
  top: String(drawn.top), side: String(drawn.side), time: element("time").textContent,
  dot: document.querySelector(".dot").getAttribute("cx"),
});
function moveTo(value) {
  scrubber.value = value;
  scrubber.dispatchEvent(new Event("input"));
}
const press = (key) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
function differs(a, b, what) {
  for (const part of Object.keys(a)) assert.notEqual(a[part], b[part], `${what}: ${part} did not change`);
}

async function drive() {
  assert.deepEqual(complaints, []);
  const { groups, bodies } = JSON.parse(element("facts").textContent);
  for (const { name, section } of bodies) {
    assert.ok(drawn.top.some(([what, text]) => what === "fillText" && text === name), `no body is called ${name}`);
    const corners = section.flat().length;
    assert.ok(drawn.side.filter(([what]) => what === "lineTo").length >= corners, `${name} is not seen from the side`);
  }
  for (const { colour } of groups)
    assert.ok(drawn.top.some(([what, value]) => what === "fillStyle" && value === colour), `no grain in ${colour}`);
  const end = state();
  assert.equal(end.time, "t = 8.00 s", "starts at the end");
  moveTo(0);
  differs(end, state(), "scrubber to the start");
  assert.equal(state().time, "t = 0.00 s");
  assert.notEqual(document.querySelector(".plot output").textContent, "", "a value beside the curve");
  moveTo(16);
  assert.deepEqual(state(), end, "the same time looks the same");

  press("ArrowLeft");
  differs(end, state(), "left arrow");
  assert.equal(state().time, "t = 7.50 s");
  press("ArrowRight");
  assert.deepEqual(state(), end, "the right arrow undoes the left one");

  element("play").click();
  await wait(500);
  element("play").click();
  const stopped = Number(scrubber.value);
  assert(stopped < 16, `played from the last frame on to ${stopped}`);
  await wait(500);
  assert.equal(Number(scrubber.value), stopped, "pauses");

  const whole = state();
  element("near").click();
  assert.notEqual(state().top, whole.top, "following the dune shows another part");
  document.querySelector(".plot svg").dispatchEvent(new MouseEvent("pointermove", { clientX: 104 }));
  assert.equal(state().time, "t = 0.00 s", "pointing at the start of a curve");
  assert.deepEqual(complaints, []);
}

drive().catch((error) => {
  console.log(error.message);
  process.exit(1);  // even while it plays
});
