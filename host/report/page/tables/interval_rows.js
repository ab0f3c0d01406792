// SPDX-License-Identifier: MIT
// interval_rows.js: estimates with intervals in a column of a table. Coordinates are percentages of the column's width,
// so that they fit any screen and paper.
import {extent} from 'd3-array';
import {scaleLinear} from 'd3-scale';
import {select} from 'd3-selection';

import {element, number_cell} from '../elements.js';
import * as numbers from '../numbers.js';

const HEIGHT = 22;

// rows: [{estimate, low, high}]. A scale to percent that includes zero and every interval.
export function scale(rows) {
  const ends = rows.flatMap((row) => [row.estimate, row.low, row.high]).filter(numbers.is_number);
  const [low, high] = extent(ends.concat(0));
  const room = (high - low) * 0.05 || 1;
  return scaleLinear()
    .domain([low - room, high + room])
    .range([2, 98]);
}

const percent = (at) => `${at.toFixed(2)}%`;

function svg_of(holder, height) {
  return select(holder).append('svg').attr('width', '100%').attr('height', height).attr('aria-hidden', 'true');
}

function add_zero(svg, x, height) {
  svg
    .append('line')
    .attr('class', 'zero')
    .attr('x1', percent(x(0)))
    .attr('x2', percent(x(0)))
    .attr('y1', 0)
    .attr('y2', height);
}

// One row; the point is filled if `sure`.
export function cell(row, x, sure) {
  const holder = element('td', {class: 'interval-plot'});
  const svg = svg_of(holder, HEIGHT);
  const middle = HEIGHT / 2;
  add_zero(svg, x, HEIGHT);
  if (numbers.is_number(row.low) && numbers.is_number(row.high)) {
    svg
      .append('line')
      .attr('class', 'bar')
      .attr('x1', percent(x(row.low)))
      .attr('x2', percent(x(row.high)))
      .attr('y1', middle)
      .attr('y2', middle);
  }
  if (numbers.is_number(row.estimate)) {
    svg
      .append('circle')
      .attr('class', sure ? 'estimate sure' : 'estimate')
      .attr('cx', percent(x(row.estimate)))
      .attr('cy', middle)
      .attr('r', 4.5);
  }
  return holder;
}

// The numbers of a row, `estimate` and its interval.
export function difference_cell(label, {estimate, low, high}, decimals) {
  return number_cell(label, numbers.signed(estimate, decimals), numbers.interval(low, high, decimals, numbers.signed));
}

// The axis above the column: ticks, and the meaning of both sides of zero.
export function axis(x, left_words, right_words) {
  const holder = element('th', {class: 'interval-plot'});
  const svg = svg_of(holder, 36);
  const ticks = x.ticks(5);
  const decimals = Math.max(0, -Math.floor(Math.log10(ticks[1] - ticks[0])));
  const words = (text, anchor, at, y = 11) =>
    svg
      .append('text')
      .attr('class', 'soft')
      .attr('x', percent(at))
      .attr('y', y)
      .attr('text-anchor', anchor)
      .style('font-size', '11px')
      .text(text);
  for (const tick of ticks) words(numbers.signed(tick, decimals), 'middle', x(tick), 30);
  if (left_words) words(left_words, 'start', 0);
  if (right_words) words(right_words, 'end', 100);
  return holder;
}
