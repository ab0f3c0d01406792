// SPDX-License-Identifier: MIT
// diagnosis.js: scatter plots of two metrics, one panel for each scenario and planner, with rank correlations.
import * as controls from '../controls.js';
import {element, fill, head_row, number_cell, number_head} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as ranking from '../ranking.js';
import {titled_table} from '../scroll_box.js';
import * as plots from './plots.js';
import * as small_plots from './small_plots.js';
import * as trial_points from './trial_points.js';

// Rows of data.trials in which both metrics are defined.
export function points_of(data, stratum, chosen) {
  const inside = new Set(stratum.combinations);
  const of = (name, i) => data.values[name][i];
  return data.trials.id
    .map((_, i) => i)
    .filter(
      (i) =>
        inside.has(data.trials.combination[i]) &&
        ranking.is_defined(of(chosen.x, i)) &&
        ranking.is_defined(of(chosen.y, i))
    );
}

export function correlation_of(data, stratum, x, y) {
  return data.correlations.find(
    (one) =>
      labels.is_of(stratum.variant.scenario, one) &&
      one.x === x &&
      one.y === y &&
      one.global_planner === stratum.global_planner &&
      (one.pedestrian_model === undefined || one.pedestrian_model === stratum.pedestrian_model)
  );
}

// Why a correlation has no value.
function reason(found) {
  return found.n < numbers.FEWEST_FOR_CORRELATION ? numbers.too_few(found.n) : `equal values (${found.n})`;
}

function correlation_words(found) {
  if (!found) return '';
  if (!numbers.is_number(found.rho)) return `ρ: ${reason(found)}`;
  const {interval, signed} = numbers;
  return `ρ ${signed(found.rho, 2)} ${interval(found.low, found.high, 2, signed)}, n ${found.n}`;
}

function draw_panel(data, trials, chosen, domains, holder, width, detail) {
  const titles = {x: labels.metric_with_unit(data, chosen.x), y: labels.metric_with_unit(data, chosen.y)};
  const {svg, x, y} = small_plots.frame(
    holder,
    width,
    {x: (pixels) => plots.linear(domains.x, pixels), y: (pixels) => plots.linear(domains.y, pixels)},
    {all: `${titles.y} against ${titles.x}`, x: titles.x, y_unit: labels.metric_unit(data, chosen.y)}
  );
  const points = trials.map((row) => {
    const at = {x: x(data.values[chosen.x][row]), y: y(data.values[chosen.y][row])};
    return {...at, row, node: trial_points.draw_mark(svg, data, row, at.x, at.y)};
  });
  trial_points.selectable(svg, data, points, [chosen.x, chosen.y], detail);
}

function correlation_cell(found) {
  if (!found) return element('td', {class: 'number'}, numbers.UNDEFINED);
  if (!numbers.is_number(found.rho)) return element('td', {class: 'number'}, reason(found));
  return number_cell(
    null,
    numbers.signed(found.rho, 2),
    numbers.interval(found.low, found.high, 2, numbers.signed),
    `p ${numbers.p_value(found.p)} · n ${found.n} · ties ${numbers.percent(found.ties_share)}`
  );
}

// One row for each stratum, one column for each pair of metrics in the layout.
function correlation_table(data, strata) {
  const pairs = labels
    .distinct(data.correlations.map((one) => JSON.stringify([one.x, one.y])))
    .map((text) => JSON.parse(text));
  if (pairs.length === 0) return null;
  const title = ([x, y]) => `${labels.metric_title(data, x)}, ${labels.metric_title(data, y)}`;
  const note =
    `Spearman\u2019s ρ over the ${data.observation}s in which both metrics are defined. Each controller\u2019s are ` +
    'ranked on their own: differences between controllers count for nothing. 95 % intervals are over them; p is from ' +
    'their permutations, the same for all controllers. Fewer than six have no correlation. ' +
    'Ties: the share of pairs of a controller\u2019s with equal values of one of the metrics. ' +
    labels.population(data);
  return titled_table(
    'title-correlations',
    'Rank correlations',
    note,
    element(
      'table',
      {class: 'results with-intervals'},
      head_row(
        element('th', {scope: 'col'}, 'scenario and planner'),
        pairs.map((pair) => number_head(title(pair)))
      ),
      element(
        'tbody',
        {},
        strata.map((stratum) =>
          element(
            'tr',
            {},
            element('th', {scope: 'row'}, stratum.title),
            pairs.map(([x, y]) => correlation_cell(correlation_of(data, stratum, x, y)))
          )
        )
      )
    )
  );
}

function first_choice(data, measured) {
  const layout = data.layouts.report.diagnosis || {};
  const known = (name) => measured.some((metric) => metric.name === name);
  const x = known(layout.x) ? layout.x : measured[0].name;
  const y = (layout.y || []).find((name) => known(name)) || measured.find((metric) => metric.name !== x).name;
  return {x, y};
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  if (data.trials.id.length < numbers.FEWEST_FOR_CORRELATION)
    return `with ${numbers.counted(data.trials.id.length, 'trial')} no correlation can be computed`;
  return labels.measured_metrics(data).length < 2 ? 'fewer than two metrics have values' : null;
}

export function mount(body, data) {
  const measured = labels.measured_metrics(data);
  const strata = labels.strata(data);
  const chosen = first_choice(data, measured);
  const holder = element('div');
  const detail = trial_points.detail_line();
  const show = () => {
    fill(holder);
    fill(detail);
    const seen = strata
      .map((stratum) => ({
        stratum,
        trials: points_of(data, stratum, chosen),
        line: correlation_words(correlation_of(data, stratum, chosen.x, chosen.y)),
      }))
      .filter((one) => one.trials.length > 0);
    if (seen.length === 0) {
      fill(holder, element('p', {class: 'note'}, 'No trial has values of both metrics.'));
      return;
    }
    const values = (name, variant) =>
      seen
        .filter((one) => one.stratum.variant === variant)
        .flatMap((one) => one.trials.map((i) => data.values[name][i]));
    small_plots.panels(holder, labels.metric_with_unit(data, chosen.y), seen, (one, plot, width) => {
      const {variant} = one.stratum;
      const domains = {x: values(chosen.x, variant), y: values(chosen.y, variant)};
      draw_panel(data, one.trials, chosen, domains, plot, width, detail);
    });
  };
  const choose = (key) => (value) => {
    chosen[key] = value;
    show();
  };
  fill(
    body,
    controls.row(
      controls.metric_select(data, 'Horizontal', measured, chosen.x, choose('x')),
      controls.metric_select(data, 'Vertical', measured, chosen.y, choose('y'))
    ),
    trial_points.mark_legend(data),
    holder,
    detail,
    correlation_table(data, strata)
  );
  show();
}
