// SPDX-License-Identifier: MIT
// pedestrian_delay.js: the delay of pedestrians by robots, from pairs of trials with and without robots.
import * as controls from '../controls.js';
import {element, fill, group_row, head_row} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {scroll_box} from '../scroll_box.js';
import {with_svg_button} from '../svg_files.js';
import * as interval_rows from './interval_rows.js';

const fewest_to_judge = 6; // pairs: a bootstrap over fewer seeds gives intervals that are too narrow

function table_of(data, rows, variants) {
  const estimates = rows.map((row) => ({estimate: row.mean_s, low: row.low, high: row.high}));
  const x = interval_rows.scale(estimates);
  const column = (...text) => element('th', {scope: 'col', class: 'number'}, text);
  const table = element(
    'table',
    {class: 'forest with-intervals'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      interval_rows.axis(x, '← sooner', 'later →'),
      column('delay', element('span', {class: 'unit'}, 's')),
      column('pairs')
    )
  );
  for (const variant of variants) {
    const own = rows.map((row, i) => i).filter((i) => variant.combinations.includes(rows[i].combination));
    if (own.length === 0) continue;
    table.append(
      element(
        'tbody',
        {},
        data.scenarios.length > 1 && group_row(variant.label, 4),
        own.map((i) =>
          element(
            'tr',
            {},
            element('th', {scope: 'row'}, labels.combination(data, rows[i].combination)),
            interval_rows.cell(
              estimates[i],
              x,
              rows[i].pairs >= fewest_to_judge && (rows[i].low > 0 || rows[i].high < 0)
            ),
            element(
              'td',
              {class: 'number', 'data-label': 'delay'},
              element('span', {class: 'mean'}, numbers.signed(rows[i].mean_s, 2)),
              element('span', {class: 'interval'}, numbers.interval(rows[i].low, rows[i].high, 2, numbers.signed))
            ),
            element('td', {class: 'number', 'data-label': 'pairs'}, rows[i].pairs)
          )
        )
      )
    );
  }
  return with_svg_button(scroll_box({'aria-label': 'Pedestrian delay'}, table));
}

const measured_rows = (data) => data.pedestrian_delay.filter((row) => numbers.is_number(row.mean_s));

// The reason why there is nothing to show, or null.
export function absent(data) {
  return measured_rows(data).length > 0
    ? null
    : 'the experiment has no variant of the scenario with robots = 0 as a reference';
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
      'Bars: 95 % intervals over seeds. Filled: the interval excludes zero and is from at least six pairs; ' +
        'intervals from fewer pairs are too narrow.'
    )
  );
}
