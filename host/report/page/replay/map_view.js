// SPDX-License-Identifier: MIT
// map_view.js: the visible part of the world: maps metres to pixels of the canvas; zoom and pan.

const MARGIN = 10; // px around the world
const LARGEST_ZOOM = 24;

export function make_map_view() {
  const view = {width: 1, height: 1, zoom: 1, center: [0, 0], lower: [0, 0], upper: [1, 1]};

  const fitting_scale = () =>
    Math.min(
      (view.width - 2 * MARGIN) / (view.upper[0] - view.lower[0]),
      (view.height - 2 * MARGIN) / (view.upper[1] - view.lower[1])
    );

  view.scale = () => Math.max(1e-3, fitting_scale() * view.zoom);
  view.x = (x) => view.width / 2 + (x - view.center[0]) * view.scale();
  view.y = (y) => view.height / 2 - (y - view.center[1]) * view.scale();
  view.world = (px, py) => [
    view.center[0] + (px - view.width / 2) / view.scale(),
    view.center[1] - (py - view.height / 2) / view.scale(),
  ];

  view.show_world = (lower, upper) => {
    view.lower = lower;
    view.upper = upper;
    view.fit();
  };

  view.fit = () => {
    view.zoom = 1;
    view.center = [(view.lower[0] + view.upper[0]) / 2, (view.lower[1] + view.upper[1]) / 2];
  };

  view.show_box = ([lower, upper]) => {
    const scale = Math.min(
      ...[0, 1].map((axis) => (axis === 0 ? view.width : view.height) / (upper[axis] - lower[axis]))
    );
    view.zoom = Math.max(1, scale / fitting_scale());
    view.look_at([0, 1].map((axis) => (lower[axis] + upper[axis]) / 2));
  };

  // Keeps the world in sight.
  view.look_at = (center) => {
    for (const axis of [0, 1]) {
      const shown = (axis === 0 ? view.width : view.height) / view.scale();
      const middle = (view.lower[axis] + view.upper[axis]) / 2;
      const room = Math.max(0, (view.upper[axis] - view.lower[axis] + 2 - shown) / 2);
      view.center[axis] = Math.min(middle + room, Math.max(middle - room, center[axis]));
    }
  };

  // Keeps the point under the pixel in place.
  view.zoom_by = (factor, px = view.width / 2, py = view.height / 2) => {
    const [x, y] = view.world(px, py);
    view.zoom = Math.min(LARGEST_ZOOM, Math.max(1, view.zoom * factor));
    view.look_at([x - (px - view.width / 2) / view.scale(), y + (py - view.height / 2) / view.scale()]);
  };

  view.shift_by = (dx, dy) => view.look_at([view.center[0] - dx / view.scale(), view.center[1] + dy / view.scale()]);

  return view;
}
