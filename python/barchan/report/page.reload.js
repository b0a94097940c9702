"use strict";
// Loads the page of a run that goes on again, and keeps what the reader looks at: place, time, animation.
(function () {
  const element = (id) => document.getElementById(id), key = "barchan " + location.pathname;
  const scrubber = element("scrubber"), near = element("near"), play = element("play");
  const configuration = document.querySelector("details");

  function save() {
    const atEnd = !scrubber || scrubber.value === scrubber.max;
    const playing = play && play.getAttribute("aria-label") === "pause";
    sessionStorage.setItem(key, JSON.stringify({
      x: scrollX, y: scrollY, open: configuration.open, near: near && near.checked, playing,
      frame: atEnd && !playing ? null : scrubber.value,  // null: the newest
    }));
  }

  function restore() {
    const kept = JSON.parse(sessionStorage.getItem(key) || "null");
    if (!kept) return;
    configuration.open = kept.open;
    if (near && kept.near !== null && near.checked !== kept.near) {
      near.checked = kept.near;
      near.dispatchEvent(new Event("change"));
    }
    if (scrubber && kept.frame !== null) {
      scrubber.value = kept.frame;
      scrubber.dispatchEvent(new Event("input"));
    }
    if (play && kept.playing) play.click();
    scrollTo(kept.x, kept.y);
  }

  function again() {  // not while nobody looks
    if (document.hidden) return void document.addEventListener("visibilitychange", again, { once: true });
    try { save(); } catch { /* a browser may keep nothing for files */ }
    location.reload();
  }

  if ("scrollRestoration" in history) history.scrollRestoration = "manual";
  try { restore(); } catch { /* as above */ }
  setTimeout(again, 1000 * Number(document.documentElement.dataset.reload));
})();
