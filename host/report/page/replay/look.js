// SPDX-License-Identifier: MIT
// look.js: the colours of the replay, read from the style sheet for the canvases.

const SERIES = 24; // colours in base.css; they repeat after that

export function read_colours() {
  const style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  const series = [];
  for (let i = 1; i <= SERIES; ++i) series.push(colour(`series-${i}`));
  return {
    dark: document.documentElement.dataset.theme === 'dark',
    background: colour('background'),
    surface: colour('surface'),
    ink: colour('ink'),
    muted: colour('muted'),
    rule: colour('rule'),
    bad: colour('bad'),
    warning: colour('warning'),
    accent: colour('accent'),
    floor: colour('replay-floor'),
    wall: colour('replay-wall'),
    furniture: colour('replay-furniture'),
    edge: colour('replay-edge'),
    person: colour('replay-person'),
    series,
  };
}

export const robot_colour = (colours, index) => colours.series[index % SERIES];
export const robot_variable = (index) => `var(--series-${(index % SERIES) + 1})`;

// Black or white, the more legible one on `colour`.
export function text_on(colour) {
  const value = parseInt(colour.replace('#', ''), 16);
  const light = 0.299 * (value >> 16) + 0.587 * ((value >> 8) & 255) + 0.114 * (value & 255);
  return light > 140 ? '#111111' : '#ffffff';
}

const WALL_M = 2.0; // shapes of at least this height are walls, others furniture
export const is_wall = (shape) => shape.height >= WALL_M;
