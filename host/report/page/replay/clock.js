// SPDX-License-Identifier: MIT
// clock.js: the time of the replay: it plays, pauses and jumps, and notifies its listeners.

export function make_clock() {
  const listeners = [];
  const clock = {t: 0, end: 0, playing: false, speed: 1};
  let last = null; // time of the previous frame, ms

  const notify = () => listeners.forEach((listener) => listener(clock));

  function frame(now) {
    if (!clock.playing) return;
    const passed = last === null ? 0 : Math.min(0.1, (now - last) / 1000);
    last = now;
    clock.t = Math.min(clock.end, clock.t + passed * clock.speed);
    if (clock.t >= clock.end) clock.playing = false;
    notify();
    if (clock.playing) requestAnimationFrame(frame);
  }

  clock.on_change = (listener) => listeners.push(listener);

  clock.play = () => {
    if (clock.playing || clock.end <= 0) return;
    if (clock.t >= clock.end) clock.t = 0;
    clock.playing = true;
    last = null;
    notify();
    requestAnimationFrame(frame);
  };

  clock.pause = () => {
    if (!clock.playing) return;
    clock.playing = false;
    notify();
  };

  clock.toggle = () => (clock.playing ? clock.pause() : clock.play());

  clock.go = (t) => {
    clock.t = Math.min(clock.end, Math.max(0, t));
    notify();
  };

  // Rounds to the time of a sample, so that a step shows a recorded state.
  clock.step = (seconds) => {
    clock.playing = false;
    clock.go(Math.round((clock.t + seconds) * 10) / 10);
  };

  clock.begin = (end) => {
    clock.playing = false;
    clock.end = end;
    clock.go(0);
  };

  return clock;
}
