// SPDX-License-Identifier: MIT
// small_plots.js: a grid of panels, one for each scenario and planner, with frame, grid lines and axes.
import {element, fill} from '../elements.js';
import * as plots from './plots.js';

const BODY = 148; // px, height of the grid
const UNIT = 12; // px, for the unit of y
const MARGIN = {top: 8, right: 12, bottom: 42, left: 46};

// An empty plot: {svg, x, y}, the axes' scales. `x`, `y`: (pixels) => scale, y's from the bottom up.
// titles: {all, x, y_unit}; lines: values of the grid lines, by default the ticks.
export function frame(holder, width, {x, y}, titles, lines) {
  fill(holder);
  const top = MARGIN.top + (titles.y_unit ? UNIT : 0);
  const bottom = top + BODY;
  const scales = {x: x([MARGIN.left, width - MARGIN.right]), y: y([bottom, top])};
  const svg = plots.frame(holder, width, bottom + MARGIN.bottom, titles.all);
  const grid = plots.add(svg, 'g', {class: 'grid'});
  for (const y_of_line of (lines || scales.y.ticks(4)).map(scales.y))
    plots.add(grid, 'line', {x1: MARGIN.left, x2: width - MARGIN.right, y1: y_of_line, y2: y_of_line});
  plots.axis_bottom(svg, scales.x, bottom, titles.x);
  const left = plots.axis_left(svg, scales.y, MARGIN.left);
  if (titles.y_unit)
    plots.add(left, 'text', {class: 'title', x: -8, y: top - 11, 'text-anchor': 'end', text: titles.y_unit});
  return {svg, ...scales};
}

// seen: [{stratum, line}]; `line`: optional text above the plot; draw(one, holder, width).
export function panels(holder, upwards, seen, draw) {
  fill(holder, element('p', {class: 'axis-note'}, `Vertical axis: ${upwards}`));
  const made = plots.panels(
    holder,
    seen.map((one) => one.stratum.title),
    plots.SMALL_PANELS
  );
  seen.forEach((one, i) => {
    const plot = made[i].querySelector('.plot');
    if (one.line !== undefined) made[i].insertBefore(element('p', {class: 'figure-line'}, one.line), plot);
    plots.responsive(plot, (inside, width) => draw(one, inside, width));
  });
}
