"use strict";
// Appended to a report page by report_in_browser.sh: uses its controls and writes what went wrong.
(async function () {
  const wrong = [], element = (id) => document.getElementById(id);
  const expect = (condition, text) => { if (!condition) wrong.push(text); };
  window.addEventListener("error", (event) => wrong.push("error: " + event.message));
  document.addEventListener("securitypolicyviolation", 
    (event) => wrong.push("wanted to load " + event.blockedURI));
  const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

  const scrubber = element("scrubber");
  const state = () => ({
    top: element("top").toDataURL(), side: element("side").toDataURL(), time: element("time").textContent,
    dot: document.querySelector(".dot").getAttribute("cx"), frame: Number(scrubber.value),
  });
  const moveTo = (value) => { scrubber.value = value; scrubber.dispatchEvent(new Event("input")); };
  const press = (key, target) =>
    target.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
  function differs(a, b, what) {
    for (const part of ["top", "side", "time", "dot"]) {
      expect(a[part] !== b[part], what + ": " + part + " did not change");
    }
  }

  try {
    const end = state();
    expect(end.time === "t = 8.00 s", "starts at '" + end.time + "', not at the end");
    moveTo(0);
    const start = state();
    differs(end, start, "scrubber to the start");
    expect(start.time === "t = 0.00 s", "the start is called '" + start.time + "'");
    expect(document.querySelector(".plot output").textContent !== "", "no value beside the curve");
    moveTo(16);
    const again = state();
    expect(again.top === end.top && again.side === end.side, "the same time looks different");

    press("ArrowLeft", document.body);
    const before = state();
    differs(end, before, "left arrow");
    expect(before.time === "t = 7.50 s", "one frame before the end is '" + before.time + "'");
    press("ArrowRight", document.body);
    expect(state().top === end.top, "the right arrow does not undo the left one");

    element("play").click();
    await wait(500);
    element("play").click();
    const stopped = state();
    expect(stopped.frame > 0 && stopped.frame < 16, "played to frame " + stopped.frame + " in half a second");
    await wait(500);
    expect(state().frame === stopped.frame, "does not pause");

    const whole = state();
    element("near").click();
    expect(state().top !== whole.top, "following the dune shows the same");

    const svg = document.querySelector(".plot svg"), box = svg.getBoundingClientRect();
    const leftEnd = { clientX: box.left + 52 / 360 * box.width, clientY: box.top + 20 };
    svg.dispatchEvent(new PointerEvent("pointermove", leftEnd));
    expect(state().time === "t = 0.00 s", "pointing at the start of a curve gives '" + state().time + "'");
    expect(document.documentElement.scrollWidth <= window.innerWidth, "the page is wider than the window");
  } catch (error) {
    wrong.push("error: " + error.message);
  }
  const verdict = document.createElement("pre");
  verdict.id = "verdict";
  verdict.textContent = wrong.join("; ") || "all as expected";
  document.body.append(verdict);
})();
