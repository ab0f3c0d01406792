// SPDX-License-Identifier: MIT
// plots.js: frames, axes, scales, symbols, legends, the tooltip and grids of panels.
import {extent} from 'd3-array';
import {axisBottom, axisLeft} from 'd3-axis';
import {scaleLinear} from 'd3-scale';
import {select} from 'd3-selection';
import {
  symbol as shape,
  symbolCircle,
  symbolCross,
  symbolDiamond,
  symbolSquare,
  symbolStar,
  symbolTriangle,
  symbolWye,
} from 'd3-shape';

import {element, fill} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {with_svg_button} from '../svg_files.js';

// Draws now and after every change of width. draw(holder, width) fills the holder.
export function responsive(holder, draw) {
  let drawn = 0;
  const redraw = () => {
    const width = Math.floor(holder.clientWidth);
    if (width === 0 || width === drawn) return;
    drawn = width;
    draw(holder, width);
  };
  new ResizeObserver(() => window.requestAnimationFrame(redraw)).observe(holder);
  redraw();
  return () => {
    drawn = 0;
    redraw();
  };
}

// Appends an SVG element to a selection. `style`: by property; all other properties are attributes.
export function add(parent, name, {style = {}, text, ...attributes}) {
  const made = parent.append(name);
  for (const [key, value] of Object.entries(attributes)) made.attr(key, value);
  for (const [key, value] of Object.entries(style)) made.style(key, value);
  return text === undefined ? made : made.text(text);
}

export function frame(holder, width, height, label) {
  const viewBox = `0 0 ${width} ${height}`;
  return add(select(holder), 'svg', {viewBox, width, height, role: 'img', 'aria-label': label});
}

// The number of ticks that fit.
function ticks_for(length, each) {
  return Math.max(2, Math.floor(length / each));
}

function number_format(value) {
  return numbers.fixed(value, Math.min(6, (String(value).split('.')[1] || '').length));
}

export function axis_bottom(parent, scale, y, title, options = {}) {
  const [left, right] = scale.range();
  const axis = axisBottom(scale)
    .ticks(ticks_for(right - left, 48))
    .tickSize(4)
    .tickPadding(5)
    .tickFormat(number_format);
  const made = add(parent, 'g', {class: 'axis', transform: `translate(0,${y})`}).call(axis);
  const title_x = options.title_x === undefined ? (left + right) / 2 : options.title_x;
  if (title) add(made, 'text', {class: 'title', x: title_x, y: 34, 'text-anchor': 'middle', text: title});
  return made;
}

export function axis_left(parent, scale, x) {
  const [bottom, top] = scale.range();
  const axis = axisLeft(scale)
    .ticks(ticks_for(bottom - top, 36))
    .tickSize(4)
    .tickPadding(4)
    .tickFormat(number_format);
  return add(parent, 'g', {class: 'axis', transform: `translate(${x},0)`}).call(axis);
}

// A linear scale with a margin at both ends; the scale of a single value is widened.
export function linear(values, range, {zero = false} = {}) {
  let [low, high] = extent(values.filter(numbers.is_number));
  if (low === undefined) [low, high] = [0, 1];
  if (zero) [low, high] = [Math.min(0, low), Math.max(0, high)];
  const room = low === high ? Math.max(0.5, Math.abs(low) * 0.1) : (high - low) * (zero ? 0 : 0.05);
  return scaleLinear()
    .domain([low >= 0 ? Math.max(0, low - room) : low - room, high + room])
    .range(range)
    .nice();
}

const SYMBOLS = [symbolCircle, symbolTriangle, symbolSquare, symbolDiamond, symbolStar, symbolWye, symbolCross];

export function symbol(index, size = 44) {
  return shape()
    .type(SYMBOLS[index % SYMBOLS.length])
    .size(size)();
}

export function draw_line(svg, series, d) {
  add(svg, 'path', {class: 'line', d, style: {stroke: series.colour, 'stroke-dasharray': series.dash}});
}

export function draw_symbol(svg, series, size, x, y) {
  const transform = `translate(${x.toFixed(1)},${y.toFixed(1)})`;
  add(svg, 'path', {class: 'mark', d: symbol(series.symbol, size), transform, style: {fill: series.colour}});
}

// The mark of a failed trial.
export function cross(radius = 3.6) {
  return `M${-radius},${-radius}L${radius},${radius}M${-radius},${radius}L${radius},${-radius}`;
}

// A symbol at (x, y), filled unless it is of a failed trial.
export function add_mark(parent, x, y, {path, colour, failed}) {
  return add(parent, 'path', {
    class: failed ? 'mark failed' : 'mark',
    transform: `translate(${x},${y})`,
    d: path,
    style: {'--colour': colour, fill: failed ? 'none' : colour},
  });
}

// entries: [{label, colour, path, failed?, line?, dash?}]
export function legend(entries) {
  const list = element('ul', {class: 'legend'});
  for (const entry of entries) {
    const item = element('li');
    const width = entry.line ? 28 : 14;
    const svg = add(select(item), 'svg', {width, height: 14, 'aria-hidden': 'true'});
    const line_style = {stroke: entry.colour, 'stroke-dasharray': entry.dash};
    if (entry.line) add(svg, 'line', {x1: 0, x2: width, y1: 7, y2: 7, class: 'line', style: line_style});
    add_mark(svg, width / 2, 7, entry);
    item.append(entry.label);
    list.append(item);
  }
  return list;
}

// The legend of a field's labels; null if there is only one.
export function field_legend(data, field, line = false) {
  const values = labels.values_of(data, field);
  if (values.length < 2) return null;
  return legend(
    values.map((value) => {
      const series = labels.series(data, field, value);
      return {
        label: labels.named(value),
        colour: series.colour,
        path: symbol(series.symbol),
        line,
        dash: series.dash,
      };
    })
  );
}

const text_measure = () => document.createElement('canvas').getContext('2d');

// Width in pixels of the longest of `texts` in the font of labels.
export function text_width(texts) {
  const context = text_measure();
  context.font = `12px ${window.getComputedStyle(document.body).fontFamily}`;
  return Math.max(0, ...texts.map((text) => context.measureText(text).width));
}

// Shortens the text to `width` pixels; a tooltip shows all of it.
export function fit_text(text, words, width) {
  let shown = words;
  while (shown.length > 4 && text_width([shown]) > width) shown = `${shown.slice(0, -2).trimEnd()}…`;
  text.text(shown);
  if (shown !== words) text.attr('data-about', words);
}

export const SMALL_PANELS = {least: 240, most: 520, most_columns: 4};

// A grid of panels, each `least` to `most` pixels wide. Returns their elements.
export function panels(holder, titles, {least, most, most_columns}) {
  const columns = Math.max(1, Math.min(most_columns, titles.length));
  const grid = element('div', {class: 'facets'});
  grid.style.maxWidth = `${columns * most}px`;
  const share = `calc((100% - ${columns - 1} * 1.75rem) / ${columns})`;
  grid.style.gridTemplateColumns = `repeat(auto-fill, minmax(max(min(100%, ${least}px), ${share}), 1fr))`;
  const made = titles.map((title) => {
    const plot = element('div', {class: 'plot'});
    const panel = element('div', {class: 'facet'}, title && element('h4', {}, title), plot);
    grid.append(with_svg_button(panel, title));
    return panel;
  });
  holder.append(grid);
  return made;
}
