// SPDX-License-Identifier: MIT
// pointer.js: recognises taps, drags and pinches of mouse, pen and fingers.

const TAP_PX = 5;

// handlers: tap(x, y), drag(dx, dy, secondary), pinch(factor, x, y), hover(x, y) or hover(null). `secondary`: with
// the right button, Shift, or two fingers. The wheel zooms only with Ctrl, so that it can scroll the page.
export function follow_pointer(canvas, handlers) {
  const down = new Map(); // pointers: id to [x, y]
  let travelled = 0;
  let secondary = false;

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
    secondary = event.button === 2 || event.shiftKey;
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
    if (travelled > TAP_PX) handlers.drag(now[0] - before[0], now[1] - before[1], secondary || down.size === 2);
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
