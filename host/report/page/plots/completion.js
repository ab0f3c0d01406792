// SPDX-License-Identifier: MIT
// completion.js: arrivals over time and the restricted mean, which includes robots that never arrive.
import {scaleLinear} from 'd3-scale';
import {curveStepAfter, line} from 'd3-shape';

import * as controls from '../controls.js';
import {bodies_of, element, fill, head_row, number_cell, number_head} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {titled_table} from '../scroll_box.js';
import * as plots from './plots.js';
import * as small_plots from './small_plots.js';

// The end of the time axis: a little after the last arrival.
function last_of_interest(rows) {
  const last = Math.max(...rows.map((row) => row.steps[row.steps.length - 1][0]));
  return Math.min(1.15 * last, Math.max(...rows.map((row) => row.horizon_s)));
}

function draw_panel(data, rows, until, title, holder, width) {
  const {svg, x, y} = small_plots.frame(
    holder,
    width,
    {
      x: (pixels) => scaleLinear().domain([0, until]).range(pixels),
      y: (pixels) => scaleLinear().domain([0, 1]).range(pixels),
    },
    {all: title, x: 'time (s)'},
    [0.5, 1]
  );
  const steps_line = line()
    .x((step) => x(step[0]))
    .y((step) => y(step[1]))
    .curve(curveStepAfter);
  for (const row of rows) {
    const series = labels.series(data, 'local_controller', data.combinations[row.combination].local_controller);
    const last = row.steps[row.steps.length - 1];
    plots.draw_line(svg, series, steps_line([[0, 0], ...row.steps, [until, last[1]]]));
    plots.draw_symbol(svg, series, 50, x(last[0]), y(last[1]));
  }
}

function table(data, rows, variants) {
  const row_of = (row) =>
    element(
      'tr',
      {},
      element('th', {scope: 'row'}, labels.combination(data, row.combination)),
      number_cell(null, numbers.fixed(row.restricted_mean_s, 1), numbers.interval(row.low, row.high, 1)),
      element('td', {class: 'number'}, numbers.fixed(row.horizon_s, 0)),
      element('td', {class: 'number'}, numbers.fixed(100 * row.arrived_share, 1)),
      element('td', {class: 'number'}, row.robots)
    );
  const made = element(
    'table',
    {class: 'results with-intervals'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      number_head('restricted mean', 's'),
      number_head('time limit', 's'),
      number_head('arrived', '%'),
      number_head('robots', '–')
    ),
    bodies_of(data, variants, 5, (variant) =>
      rows.filter((row) => variant.combinations.includes(row.combination)).map(row_of)
    )
  );
  return titled_table(
    'title-completion',
    'Restricted mean time to arrive',
    `The mean over all robots; a robot that has not arrived counts with the time limit. 95 % intervals over ${data.observation}s; ` +
      labels.population(data),
    made
  );
}

function show_variants(data, rows, variants, holder) {
  fill(holder);
  const keys = variants.map((variant) => variant.key);
  const seen = labels
    .strata(data)
    .filter((stratum) => keys.includes(stratum.variant.key))
    .map((stratum) => ({
      stratum,
      rows: rows.filter((row) => stratum.combinations.includes(row.combination) && (row.steps || []).length > 0),
    }))
    .filter((one) => one.rows.length > 0);
  const draw = (one, plot, width) => {
    const until = last_of_interest(
      seen.filter((other) => other.stratum.variant === one.stratum.variant).flatMap((other) => other.rows)
    );
    draw_panel(data, one.rows, until, `Arrivals over time: ${one.stratum.title}`, plot, width);
  };
  if (seen.length > 0) small_plots.panels(holder, 'share of robots that have arrived', seen, draw);
  holder.append(table(data, rows, variants));
}

const measured_rows = (data) => data.completion.filter((row) => numbers.is_number(row.restricted_mean_s));

// The reason why there is nothing to show, or null.
export function absent(data) {
  return measured_rows(data).length > 0 ? null : 'completion times were not measured';
}

export function mount(body, data) {
  const rows = measured_rows(data);
  const variants = labels.variants(data);
  const first = controls.first_variant(variants, rows.length);
  const holder = element('div');
  const show = (key) =>
    show_variants(
      data,
      rows,
      variants.filter((variant) => key === 'all' || variant.key === key),
      holder
    );
  fill(
    body,
    controls.row(controls.variant_select(variants, first, show)),
    plots.field_legend(data, 'local_controller', true),
    holder
  );
  show(first);
}
