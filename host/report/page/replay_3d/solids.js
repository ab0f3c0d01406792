// SPDX-License-Identifier: MIT
// solids.js: builds many solids into one mesh, each with a colour of its own, so that little has to be drawn.
// Places are [x, y, height] of the world; three.js's are (x, height, -y).
import {THREE} from './three.js';

const CIRCLE_PARTS = 28;

export function circle(x, y, radius, parts = CIRCLE_PARTS) {
  return Array.from({length: parts}, (_, i) => {
    const angle = (2 * Math.PI * i) / parts;
    return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
  });
}

export function rectangle(x, y, length, width) {
  const [a, b] = [length / 2, width / 2];
  return [
    [x - a, y - b],
    [x + a, y - b],
    [x + a, y + b],
    [x - a, y + b],
  ];
}

// A convex outline moved towards its middle by at most `inset`.
export function shrunk(outline, inset) {
  const middle = [0, 1].map((axis) => outline.reduce((sum, point) => sum + point[axis], 0) / outline.length);
  return outline.map((point) => {
    const out = [point[0] - middle[0], point[1] - middle[1]];
    const length = Math.hypot(...out);
    const kept = length > 0 ? Math.max(0.2, 1 - inset / length) : 1;
    return [middle[0] + kept * out[0], middle[1] + kept * out[1]];
  });
}

// Collects triangles. Textures lie in metres: along and up the sides, along x and y on the tops.
export function make_solids() {
  const places = [];
  const normals = [];
  const textures = [];
  const colours = [];

  function corner([x, y, height], [nx, ny, up], [u, v], colour) {
    places.push(x, height, -y);
    normals.push(nx, up, -ny);
    textures.push(u, v);
    colours.push(colour.r, colour.g, colour.b);
  }

  // The sides between a counter-clockwise outline at one height and one of as many corners at another.
  function sides(lower, from, upper, to, colour) {
    let along = 0;
    lower.forEach((a, i) => {
      const next = (i + 1) % lower.length;
      const b = lower[next];
      const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1e-9;
      const lean = to > from ? Math.hypot(a[0] - upper[i][0], a[1] - upper[i][1]) / (to - from) : 0;
      const size = Math.hypot(1, lean);
      const normal = [(b[1] - a[1]) / length / size, -(b[0] - a[0]) / length / size, lean / size];
      const square = [
        [[...a, from], [along, from]],
        [[...b, from], [along + length, from]],
        [[...upper[next], to], [along + length, to]],
        [[...upper[i], to], [along, to]],
      ];
      for (const k of [0, 1, 2, 0, 2, 3]) corner(square[k][0], normal, square[k][1], colour);
      along += length;
    });
  }

  function top(outline, height, colour) {
    for (let i = 1; i + 1 < outline.length; ++i)
      for (const point of [outline[0], outline[i], outline[i + 1]])
        corner([...point, height], [0, 0, 1], point, colour);
  }

  return {
    sides,
    top,

    // A convex outline between two heights; `slope`: how far its top is drawn in.
    prism(outline, from, to, colour, {slope = 0, top_colour = colour} = {}) {
      const upper = slope > 0 ? shrunk(outline, slope) : outline;
      sides(outline, from, upper, to, colour);
      top(upper, to, top_colour);
    },

    // A surface of revolution: `profile` lists [height, radius along x, radius along y] from below.
    turned(x, y, profile, colour, parts = 12) {
      const ring = ([, a, b]) => circle(0, 0, 1, parts).map(([cos, sin]) => [x + a * cos, y + b * sin]);
      for (let i = 0; i + 1 < profile.length; ++i)
        sides(ring(profile[i]), profile[i][0], ring(profile[i + 1]), profile[i + 1][0], colour);
    },

    // A wheel whose axle lies along y.
    wheel(x, y, height, radius, width, colour) {
      const rim = circle(x, height, radius, 16);
      for (const [i, a] of rim.entries()) {
        const b = rim[(i + 1) % rim.length];
        const out = [(a[0] + b[0]) / 2 - x, 0, (a[1] + b[1]) / 2 - height].map((one) => one / radius);
        const [left, right] = [y + width / 2, y - width / 2];
        const square = [
          [a[0], left, a[1]],
          [b[0], left, b[1]],
          [b[0], right, b[1]],
          [a[0], right, a[1]],
        ];
        for (const k of [0, 1, 2, 0, 2, 3]) corner(square[k], out, [0, 0], colour);
        for (const [side, normal] of [
          [left, 1],
          [right, -1],
        ]) {
          const [p, q] = normal > 0 ? [b, a] : [a, b];
          const slice = [
            [x, side, height],
            [p[0], side, p[1]],
            [q[0], side, q[1]],
          ];
          for (const point of slice) corner(point, [0, normal, 0], [0, 0], colour);
        }
      }
    },

    empty: () => places.length === 0,

    geometry() {
      const made = new THREE.BufferGeometry();
      const add = (name, list, size) =>
        made.setAttribute(name, new THREE.BufferAttribute(new Float32Array(list), size));
      add('position', places, 3);
      add('normal', normals, 3);
      add('uv', textures, 2);
      add('color', colours, 3);
      return made;
    },
  };
}

export function colour_of(text) {
  return new THREE.Color(text);
}
