// SPDX-License-Identifier: MIT
// heat_map.js: planner by controller for one metric, as an HTML table, for screen readers and printing.
import {scaleLinear} from 'd3-scale';

import * as controls from '../controls.js';
import {element, fill, head_row, hidden} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as ranking from '../ranking.js';
import {scroll_box} from '../scroll_box.js';
import {with_svg_button} from '../svg_files.js';

const CELL_REM = 4.4; // width of a cell with its gap, and of the planners' names
const NAMES_REM = 7;
const STRONGEST = 0.7; // opacity; above this the numbers are hard to read

// One grid for each variant and pedestrian model: {title, planners, controllers, cells: [[summary or null]]}.
export function grids(data, metric) {
  const index = data.metrics.findIndex((candidate) => candidate.name === metric);
  const models = labels.values_of(data, 'pedestrian_model');
  return labels
    .variants(data)
    .flatMap((variant) =>
      models.map((model) => {
        const inside = variant.combinations.filter((i) => data.combinations[i].pedestrian_model === model);
        const names = (field) => labels.distinct(inside.map((i) => data.combinations[i][field]));
        const at = (planner, controller) =>
          inside.find(
            (i) =>
              data.combinations[i].global_planner === planner && data.combinations[i].local_controller === controller
          );
        const planners = names('global_planner');
        const controllers = names('local_controller');
        const cells = planners.map((planner) =>
          controllers.map((controller) => {
            const i = at(planner, controller);
            return i === undefined ? null : {...data.summaries[i][index], combination: i};
          })
        );
        const title = variant.label + (models.length > 1 ? ` · ${labels.named(model)}` : '');
        return {title, planners, controllers, cells};
      })
    )
    .filter((grid) => grid.planners.length > 0);
}

function cell_element(cell, good, best, decimals, unit) {
  if (cell === null) return element('td', {}, element('span', {class: 'cell nothing', 'data-about': 'not run'}, '\u00a0'));
  if (!ranking.is_defined(cell.mean)) {
    return element(
      'td',
      {},
      element('span', {class: 'cell nothing', 'data-about': 'undefined in every trial'}, numbers.UNDEFINED)
    );
  }
  const about = numbers.with_unit(numbers.interval(cell.low, cell.high, decimals), unit);
  const made = element(
    'span',
    {class: best ? 'cell best-cell' : 'cell', 'data-about': `${about} from ${numbers.counted(cell.defined, 'trial')}`},
    element('span', {}, best && hidden('best: '), numbers.fixed(cell.mean, decimals))
  );
  made.style.setProperty('--strength', scaleLinear().range([0.03, STRONGEST])(good).toFixed(3));
  return element('td', {}, made);
}

// The colour scale from the worst to the best value.
function scale_key(means, decimals, direction) {
  const defined = means.filter(ranking.is_defined);
  const ends = [Math.min(...defined), Math.max(...defined)];
  if (defined.length === 0 || ends[0] === ends[1]) return null;
  if (direction === 'lower') ends.reverse();
  const bar = element('span', {class: 'bar'});
  bar.style.setProperty('--strongest', STRONGEST);
  return element(
    'p',
    {class: 'heat-key number', 'aria-hidden': 'true'},
    numbers.fixed(ends[0], decimals),
    bar,
    numbers.fixed(ends[1], decimals),
    direction !== 'none' && ' best'
  );
}

function grid_table(data, grid, metric, decimals) {
  const flat = grid.cells.flat();
  const means = flat.map((cell) => (cell === null ? null : cell.mean));
  const goodness = ranking.goodness(means, metric.direction);
  const width = grid.controllers.length;
  const is_best = (cell) => cell && ranking.is_best(data, data.combinations[cell.combination], metric.name);
  const facet = element(
    'div',
    {class: 'facet'},
    scroll_box(
      {'aria-label': grid.title},
      element(
        'table',
        {class: 'heat'},
        element('caption', {}, element('h4', {}, grid.title)),
        head_row(
          element('td'),
          grid.controllers.map((name) => element('th', {scope: 'col'}, name))
        ),
        element(
          'tbody',
          {},
          grid.planners.map((name, r) =>
            element(
              'tr',
              {},
              element('th', {scope: 'row'}, name),
              grid.cells[r].map((cell, c) =>
                cell_element(cell, goodness[r * width + c], is_best(cell), decimals, metric.unit)
              )
            )
          )
        )
      )
    ),
    scale_key(means, decimals, metric.direction)
  );
  return with_svg_button(facet, `${metric.name} ${grid.title}`);
}

function key_words(data, metric) {
  const better = {
    higher: 'Stronger colour: higher, which is better.',
    lower: 'Stronger colour: lower, which is better.',
    none: 'Stronger colour: higher; neither direction is better.',
  }[metric.direction];
  const framed = metric.direction === 'none' ? '' : ' Frame: the best of the scenario, if it differs significantly from all others.';
  return `${labels.metric_with_unit(data, metric.name)}: ${metric.description}. ${better}${framed}`;
}

function differs(data, name) {
  const index = data.metrics.findIndex((metric) => metric.name === name);
  return labels
    .variants(data)
    .some((variant) => labels.distinct(variant.combinations.map((i) => (data.summaries[i][index] || {}).mean)).length > 1);
}

// The layout's metric, or the first of the tables in which combinations differ.
export function default_metric(data, measured) {
  const columns = data.layouts.report.tables.flatMap((table) => table.columns.map((column) => column.metric));
  const names = [(data.layouts.report.heat_map || {}).metric, ...columns].filter((name) =>
    measured.some((metric) => metric.name === name)
  );
  return names.find((name) => differs(data, name)) || names[0] || measured[0].name;
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  const pairs = Math.max(
    labels.values_of(data, 'global_planner').length,
    labels.values_of(data, 'local_controller').length
  );
  const is_measured = labels.measured_metrics(data).length > 0;
  return pairs < 2 || !is_measured ? 'there is one planner and one controller' : null;
}

export function mount(body, data) {
  const measured = labels.measured_metrics(data);
  const holder = element('div', {class: 'facets heat-grids'});
  const note = element('p', {class: 'note'});
  const show = (name) => {
    const metric = labels.metric(data, name);
    const all = grids(data, name);
    const decimals = labels.decimals(
      data,
      name,
      all.flatMap((grid) => grid.cells.flat().map((cell) => cell && cell.mean))
    );
    const columns = Math.max(...all.map((grid) => grid.controllers.length));
    holder.style.setProperty('--widest', `${NAMES_REM + CELL_REM * columns}rem`);
    fill(
      holder,
      all.map((grid) => grid_table(data, grid, metric, decimals))
    );
    fill(note, key_words(data, metric));
  };
  const first = default_metric(data, measured);
  show(first);
  fill(body, controls.row(controls.metric_select(data, 'Metric', measured, first, show)), holder, note);
}
