// SPDX-License-Identifier: MIT
// threshold_curves.js: metrics over their thresholds: one panel for each scenario and planner, one line with a band for
// each controller.
import {extent} from 'd3-array';
import {scaleLinear} from 'd3-scale';
import {area, line} from 'd3-shape';

import * as controls from '../controls.js';
import {element, fill} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as plots from './plots.js';
import * as small_plots from './small_plots.js';

// The layout's entry for a metric: {metric, coordinate, coordinate_unit}.
function layout_of(data, metric) {
  return (data.layouts.report.curves || []).find((one) => one.metric === metric) || {};
}

// The domains of the axes.
function extents_of(data, curves) {
  const points = curves.flatMap((curve) => curve.points);
  const unit = numbers.unit(curves[0].coordinate_unit || '');
  return {
    title: (layout_of(data, curves[0].metric).coordinate || 'threshold') + (unit ? ` (${unit})` : ''),
    coordinates: points.map((point) => point[0]),
    values: points.flatMap((point) => point.slice(1, 4)).filter(numbers.is_number),
  };
}

function has_values(curve) {
  return curve.points.some((point) => numbers.is_number(point[1]));
}

function series_of(data, curve) {
  return labels.series(data, 'local_controller', data.combinations[curve.combination].local_controller);
}

function draw_curve(svg, curve, series, x, y) {
  const defined = (point) => numbers.is_number(point[1]);
  const banded = (point) => numbers.is_number(point[2]) && numbers.is_number(point[3]);
  const band = area()
    .defined(banded)
    .x((point) => x(point[0]))
    .y0((point) => y(point[2]))
    .y1((point) => y(point[3]));
  const means = line()
    .defined(defined)
    .x((point) => x(point[0]))
    .y((point) => y(point[1]));
  plots.add(svg, 'path', {class: 'band', style: {fill: series.colour}, d: band(curve.points)});
  plots.draw_line(svg, series, means(curve.points));
  for (const point of curve.points.filter(defined)) plots.draw_symbol(svg, series, 34, x(point[0]), y(point[1]));
}

function draw_panel(data, metric, one, extents, holder, width) {
  const {svg, x, y} = small_plots.frame(
    holder,
    width,
    {
      x: (pixels) => scaleLinear().domain(extent(extents.coordinates)).range(pixels),
      y: (pixels) => plots.linear(extents.values, pixels, {zero: true}),
    },
    {
      all: `${labels.metric_title(data, metric)} over its threshold: ${one.stratum.title}`,
      x: extents.title,
      y_unit: labels.metric_unit(data, metric),
    }
  );
  for (const curve of one.curves) draw_curve(svg, curve, series_of(data, curve), x, y);
}

// What is remarkable about a panel's curves.
function remarks(curves, different) {
  const is_zero = (curve) => curve.points.every((point) => point[1] === 0 || !numbers.is_number(point[1]));
  return [
    curves.length > 1 && different.length === 1 && 'the same for all controllers',
    curves.every(is_zero) && '0 at every threshold',
  ].filter(Boolean);
}

// [{stratum, curves}]: of curves that are equal, one alone; the stratum's title says so, and where all values are 0.
export function panels_of(strata, found) {
  return strata
    .map((stratum) => {
      const curves = found.filter((curve) => stratum.combinations.includes(curve.combination));
      const points = curves.map((curve) => JSON.stringify(curve.points));
      const different = curves.filter((_, i) => points.indexOf(points[i]) === i);
      const title = [stratum.title, ...(curves.length > 0 ? remarks(curves, different) : [])].join(' · ');
      return {stratum: {...stratum, title}, curves: different};
    })
    .filter((one) => one.curves.length > 0);
}

function show_metric(data, metric, holder, note) {
  const found = data.curves.filter((curve) => curve.metric === metric && has_values(curve));
  const seen = panels_of(labels.strata(data), found);
  const extents = (stratum) =>
    extents_of(
      data,
      found.filter((curve) => stratum.variant.combinations.includes(curve.combination))
    );
  small_plots.panels(holder, labels.metric_with_unit(data, metric), seen, (one, plot, width) =>
    draw_panel(data, metric, one, extents(one.stratum), plot, width)
  );
  const about = labels.metric(data, metric);
  fill(note, about ? `${about.description} (${labels.direction_words(about.direction)}).` : '');
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.curves.some(has_values) ? null : 'no metric was measured over a range of thresholds';
}

export function mount(body, data) {
  const names = labels.distinct(data.curves.filter(has_values).map((curve) => curve.metric));
  const holder = element('div');
  const note = element('p', {class: 'note'});
  const options = names.map((name) => ({value: name, label: labels.metric_with_unit(data, name)}));
  fill(
    body,
    controls.row(controls.select('Metric', options, names[0], (name) => show_metric(data, name, holder, note))),
    plots.field_legend(data, 'local_controller', true),
    holder,
    note
  );
  show_metric(data, names[0], holder, note);
}
