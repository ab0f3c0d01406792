// SPDX-License-Identifier: MIT
// pedestrian_delay.js: the delay of pedestrians by robots, from pairs of trials with and without robots.
import * as controls from '../controls.js';
import {bodies_of, element, fill, head_row, number_head} from '../elements.js';
import * as labels from '../labels.js';
import {scroll_box} from '../scroll_box.js';
import {with_svg_button} from '../svg_files.js';
import * as interval_rows from './interval_rows.js';

function table_of(data, rows, variants) {
  const estimates = rows.map((row) => ({...row, estimate: row.mean_s}));
  const x = interval_rows.scale(estimates);
  const row_of = (one) =>
    element(
      'tr',
      {},
      element('th', {scope: 'row'}, labels.combination(data, one.combination)),
      interval_rows.cell(one, x, one.low > 0 || one.high < 0),
      interval_rows.difference_cell('delay', one, 2),
      element('td', {class: 'number', 'data-label': 'pairs'}, one.pairs),
      element('td', {class: 'number', 'data-label': 'n'}, one.n)
    );
  const table = element(
    'table',
    {class: 'forest with-intervals'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      interval_rows.axis(x, '← sooner', 'later →'),
      number_head('delay', 's'),
      number_head('pairs'),
      number_head('n')
    ),
    bodies_of(data, variants, 4, (variant) =>
      estimates.filter((one) => variant.combinations.includes(one.combination)).map(row_of)
    )
  );
  return with_svg_button(scroll_box({'aria-label': 'Pedestrian delay'}, table));
}

const measured_rows = (data) => data.pedestrian_delay.filter((row) => row.pairs > 0);

// The reason why there is nothing to show, or null.
export function absent(data) {
  const rows = measured_rows(data);
  return rows.length > 0 ? null : 'the experiment has no variant of the scenario with robots = 0 as a reference';
}

export function mount(body, data) {
  const rows = measured_rows(data);
  const variants = labels.variants(data);
  const first = controls.first_variant(variants, rows.length);
  const holder = element('div');
  const show = (key) =>
    fill(
      holder,
      table_of(
        data,
        rows,
        variants.filter((variant) => key === 'all' || variant.key === key)
      )
    );
  show(first);
  fill(
    body,
    controls.row(controls.variant_select(variants, first, show)),
    holder,
    element(
      'p',
      {class: 'note'},
      `Bars: 95 % intervals over n ${data.observation}s, from ten on. Filled: the interval excludes zero. ${labels.population(data)}`
    )
  );
}
