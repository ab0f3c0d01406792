// SPDX-License-Identifier: MIT
// pointer.js: mouse, pen and fingers on a picture, told apart as taps, drags and pinches.

const TAP_PX = 5;

// handlers: tap(x, y), drag(dx, dy, second_way), pinch(factor, x, y), hover(x, y) or hover(null). `second_way`: by
// the right button, with Shift, or by two fingers. Wheels zoom only with Ctrl, so that the page can be scrolled.
export function follow_pointer(canvas, handlers) {
  const down = new Map(); // pointers: id to [x, y]
  let travelled = 0;
  let second_way = false;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const middle = () => {
    const all = [...down.values()];
    return [0, 1].map((axis) => all.reduce((sum, one) => sum + one[axis], 0) / all.length);
  };
  const spread = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };

  canvas.addEventListener('pointerdown', (event) => {
    if (down.size === 0) travelled = 0;
    second_way = event.button === 2 || event.shiftKey;
    down.set(event.pointerId, place(event));
    canvas.setPointerCapture(event.pointerId);
  });

  canvas.addEventListener('pointermove', (event) => {
    if (!down.has(event.pointerId)) {
      handlers.hover(...place(event));
      return;
    }
    const before = middle();
    const spread_before = down.size === 2 ? spread() : 0;
    down.set(event.pointerId, place(event));
    const now = middle();
    travelled += Math.hypot(now[0] - before[0], now[1] - before[1]);
    if (travelled > TAP_PX) handlers.drag(now[0] - before[0], now[1] - before[1], second_way || down.size === 2);
    if (down.size === 2 && spread_before > 0) {
      travelled = Infinity;
      handlers.pinch(spread() / spread_before, ...now);
    }
  });

  const up = (event) => {
    if (!down.delete(event.pointerId)) return;
    if (event.type === 'pointerup' && down.size === 0 && travelled <= TAP_PX) handlers.tap(...place(event));
  };
  canvas.addEventListener('pointerup', up);
  canvas.addEventListener('pointercancel', up);
  canvas.addEventListener('pointerleave', () => handlers.hover(null));
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener(
    'wheel',
    (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      handlers.pinch(Math.exp(-event.deltaY / 200), ...place(event));
    },
    {passive: false}
  );
}
