// SPDX-License-Identifier: MIT
// distributions.js: one point for each trial, one row for each combination.
import {median} from 'd3-array';

import * as controls from '../controls.js';
import {element, fill} from '../elements.js';
import * as labels from '../labels.js';
import * as ranking from '../ranking.js';
import * as plots from './plots.js';
import * as trial_points from './trial_points.js';

const ROW = 24; // px, a combination
const SPREAD = 7; // px, vertical jitter of the points of a row
const UNDEFINED = 40; // px, column of the trials without a value
const TOP = 26;
const BOTTOM = 46;

// {rows: [{label, trials: [row of data.trials], median}], has_undefined}
export function model(data, variant, metric) {
  const values = data.values[metric];
  const of = new Map(variant.combinations.map((combination) => [combination, []]));
  data.trials.combination.forEach((combination, i) => {
    if (of.has(combination) && !['skipped', 'unsupported'].includes(data.trials.outcome[i])) of.get(combination).push(i);
  });
  const rows = variant.combinations.map((combination) => {
    const trials = of.get(combination);
    const defined = trials.map((i) => values[i]).filter(ranking.is_defined);
    return {
      label: labels.combination(data, combination),
      trials,
      median: defined.length > 1 ? median(defined) : null,
    };
  });
  return {rows, has_undefined: rows.some((row) => row.trials.some((i) => !ranking.is_defined(values[i])))};
}

function draw_rows(svg, rows, left, right) {
  rows.forEach((row, r) => {
    const y = TOP + (r + 0.5) * ROW;
    const text = plots.add(svg, 'text', {x: left - 10, y, dy: '0.32em', 'text-anchor': 'end'});
    plots.fit_text(text, row.label, left - 10);
    plots.add(plots.add(svg, 'g', {class: 'grid'}), 'line', {x1: left, x2: right, y1: y, y2: y});
  });
}

function draw_undefined_column(svg, right, bottom, trials_without) {
  if (!trials_without) return;
  plots.add(svg, 'text', {
    class: 'soft',
    x: right + UNDEFINED / 2 + 4,
    y: 14,
    'text-anchor': 'middle',
    style: {'font-size': '11px'},
    text: 'undefined',
  });
  const x = right + 10;
  plots.add(plots.add(svg, 'g', {class: 'grid'}), 'line', {x1: x, x2: x, y1: TOP - 6, y2: bottom});
}

// The median bar, with a rim in the background colour.
function draw_medians(svg, rows, x) {
  rows.forEach((row, r) => {
    if (row.median === null) return;
    const middle = TOP + (r + 0.5) * ROW;
    const at = {x1: x(row.median), x2: x(row.median), y1: middle - ROW / 2 + 2, y2: middle + ROW / 2 - 2};
    for (const kind of ['median rim', 'median']) plots.add(svg, 'line', {class: kind, ...at});
  });
}

function draw_panel(data, shown, domain, metric, holder, width, detail) {
  fill(holder);
  const values = data.values[metric];
  const left = Math.min(plots.text_width(shown.rows.map((row) => row.label)) + 14, width * 0.48);
  const right = width - 8 - (shown.has_undefined ? UNDEFINED + 14 : 4);
  const bottom = TOP + shown.rows.length * ROW;
  const x = plots.linear(domain, [left, right]);
  const title = labels.metric_with_unit(data, metric);
  const svg = plots.frame(holder, width, bottom + BOTTOM, `${title} of every trial, by combination`);
  draw_rows(svg, shown.rows, left, right);
  draw_undefined_column(svg, right, bottom, shown.has_undefined);
  plots.axis_bottom(svg, x, bottom, title);
  const points = [];
  shown.rows.forEach((row, r) => {
    const middle = TOP + (r + 0.5) * ROW;
    for (const trial of row.trials) {
      const jitter = trial_points.jitter(data.trials.id[trial]);
      const defined = ranking.is_defined(values[trial]);
      const at = defined
        ? x(values[trial])
        : right + 10 + UNDEFINED / 2 + trial_points.jitter(data.trials.id[trial], 1) * (UNDEFINED / 2 - 8);
      const y = middle + (row.trials.length > 1 ? jitter * SPREAD : 0);
      points.push({x: at, y: middle, row: trial, node: trial_points.draw_mark(svg, data, trial, at, y)});
    }
  });
  draw_medians(svg, shown.rows, x);
  trial_points.selectable(svg, data, points, [metric], detail);
}

function default_metric(data, measured) {
  const wanted = (data.layouts.report.distributions || {}).metric;
  return measured.some((metric) => metric.name === wanted) ? wanted : measured[0].name;
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return labels.measured_metrics(data).length > 0 ? null : 'no metric has a value in any trial';
}

export function mount(body, data) {
  const measured = labels.measured_metrics(data);
  const variants = labels.variants(data).filter((variant) => variant.combinations.length > 0);
  const chosen = {metric: default_metric(data, measured), variant: 'all'};
  const holder = element('div');
  const detail = trial_points.detail_line();
  const show = () => {
    fill(holder);
    fill(detail);
    const seen = variants.filter((variant) => chosen.variant === 'all' || variant.key === chosen.variant);
    const panels = plots.panels(
      holder,
      seen.map((variant) => (variants.length > 1 ? variant.label : null)),
      {least: 340, most: 760, most_columns: 3}
    );
    const domain = data.values[chosen.metric];
    seen.forEach((variant, i) => {
      const shown = model(data, variant, chosen.metric);
      plots.responsive(panels[i].querySelector('.plot'), (plot, width) =>
        draw_panel(data, shown, domain, chosen.metric, plot, width, detail)
      );
    });
  };
  fill(
    body,
    controls.row(
      controls.metric_select(data, 'Metric', measured, chosen.metric, (name) => {
        chosen.metric = name;
        show();
      }),
      controls.variant_select(variants, 'all', (key) => {
        chosen.variant = key;
        show();
      })
    ),
    trial_points.mark_legend(data),
    holder,
    detail
  );
  show();
}
