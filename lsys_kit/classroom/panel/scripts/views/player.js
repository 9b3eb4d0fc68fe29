// Step after step by itself: play, back, single steps, speed, loop.

import { made, button, face, freshId, list } from "./controls.js";
import { worded } from "./language.js";

const SPEEDS = [["1200", "slow"], ["600", "normal"], ["250", "fast"]]; // milliseconds a step

// `steps` tells { now, most }; `go` goes to a step.
export function player(steps, go, moved) {
  let timer = 0, pause = 600;
  const play = button("play", worded("play"), toggle, { class: "lsys-button lsys-play" });
  const back = button("back", worded("one step back"), () => one(-1)), forward = button("forward", worded("one step on"), () => one(1));
  const first = button("first", worded("to step 0"), () => { stop(); go(0); });
  const loop = made("input", { type: "checkbox", id: freshId() });
  const speed = list("speed", worded("how long each step is shown"), SPEEDS.map(([value, name]) => [value, worded(name)]), "600", (value) => {
    pause = Number(value);
    if (timer) start();
  }, worded("speed"));
  const element = made("div.lsys-player", { role: "group", "aria-label": worded("play") }, first, back, play, forward, speed.element,
    made("label.lsys-check", { for: loop.id }, loop, worded("loop")));

  function one(way) {
    stop();
    const { now, most } = steps();
    go(Math.max(0, Math.min(most, now + way)));
  }

  function tick() {
    const { now, most } = steps();
    if (now < most) go(now + 1);
    else if (loop.checked) go(0);
    else stop();
  }

  function start() {
    clearInterval(timer);
    timer = setInterval(tick, pause);
    face(play, "pause", worded("pause"));
    moved(true);
  }

  function stop() {
    if (!timer) return;
    clearInterval(timer);
    timer = 0;
    face(play, "play", worded("play"));
    moved(false);
  }

  function toggle() {
    if (timer) return stop();
    const { now, most } = steps();
    if (now >= most) go(0);
    start();
  }

  return { element, stop, get playing() { return timer !== 0; } };
}
