// SPDX-License-Identifier: MIT
// comparisons.js: paired differences between combinations on what both met, as a forest plot.
import * as controls from '../controls.js';
import {bodies_of, element, fill, head_row, number_head} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {scroll_box} from '../scroll_box.js';
import {with_svg_button} from '../svg_files.js';
import * as interval_rows from './interval_rows.js';

const SIGNIFICANT = 0.05;
const TESTS = {
  signed_rank: {
    estimate: 'median difference',
    name: 'Wilcoxon\u2019s signed-rank test, difference by Hodges and Lehmann',
  },
  mean: {estimate: 'mean difference', name: 'Student\u2019s test of the mean, with one loss and one gain of all added'},
};

// The estimate that corresponds to the test.
export function estimate_of(comparison) {
  return comparison.test === 'mean'
    ? {estimate: comparison.mean_difference, low: comparison.mean_low, high: comparison.mean_high}
    : {estimate: comparison.median_difference, low: comparison.low, high: comparison.high};
}

// The interval excludes 0, and does so after the correction for all comparisons. Interval and p are one procedure.
export function is_sure(comparison) {
  const {low, high} = estimate_of(comparison);
  return numbers.is_number(comparison.p_holm) && comparison.p_holm < SIGNIFICANT && (low > 0 || high < 0);
}

// The comparisons of one metric and one varied field, in `variant` or in all variants.
export function chosen_rows(data, chosen) {
  return data.comparisons.filter(
    (one) =>
      one.metric === chosen.metric &&
      one.varied === chosen.varied &&
      (chosen.variant === 'all' || `${one.scenario}/${one.robots}` === chosen.variant)
  );
}

function given_words(data, comparison) {
  const naming = labels.naming_fields(data);
  return Object.entries(comparison.given)
    .filter(([field]) => naming.includes(field))
    .map(([, label]) => labels.named(label))
    .join(' + ');
}

function row_element(data, comparison, x, decimals) {
  const estimate = estimate_of(comparison);
  const sure = is_sure(comparison);
  const given = given_words(data, comparison);
  const number = (label, ...content) => element('td', {class: 'number', 'data-label': label}, content);
  return element(
    'tr',
    {class: sure ? 'sure' : null},
    element(
      'th',
      {scope: 'row'},
      `${labels.named(comparison.b)} \u2212 ${labels.named(comparison.a)}`,
      given && element('span', {class: 'given'}, ` with ${given}`)
    ),
    interval_rows.cell(estimate, x, sure),
    interval_rows.difference_cell('difference', estimate, decimals),
    number('p', numbers.p_value(comparison.p)),
    number('p (Holm)', numbers.p_value(comparison.p_holm)),
    number('effect', numbers.signed(comparison.effect, 2)),
    number(
      'n',
      `${comparison.n}`,
      comparison.ties > 0 && element('span', {class: 'given'}, ` (${numbers.counted(comparison.ties, 'tie')})`)
    )
  );
}

function side_words(direction) {
  return {
    lower: ['← first better', 'second better →'],
    higher: ['← second better', 'first better →'],
    none: ['', ''],
  }[direction];
}

function head(metric, title, x) {
  return head_row(
    element('th', {scope: 'col'}, 'first \u2212 second'),
    interval_rows.axis(x, ...side_words(metric.direction)),
    number_head(title, numbers.unit(metric.unit)),
    ['p', 'p (Holm)', 'effect', 'n'].map((name) => number_head(name))
  );
}

function table(data, rows, chosen) {
  const metric = labels.metric(data, chosen.metric);
  const estimates = rows.map(estimate_of);
  const x = interval_rows.scale(estimates);
  const decimals = labels.decimals(
    data,
    chosen.metric,
    estimates.map((one) => one.estimate)
  );
  const {estimate} = TESTS[rows[0].test] || {estimate: 'difference'};
  const bodies = bodies_of(data, labels.variants(data), 7, (variant) =>
    rows.filter((row) => labels.is_of(variant.scenario, row)).map((row) => row_element(data, row, x, decimals))
  );
  const made = element('table', {class: 'forest with-intervals'}, head(metric, estimate, x), bodies);
  return with_svg_button(scroll_box({'aria-label': 'Paired differences'}, made), chosen.metric);
}

function note_words(data, rows, chosen) {
  const metric = labels.metric(data, chosen.metric);
  const test = TESTS[rows[0].test];
  const declared = (data.layouts.report.comparisons || []).filter((one) => one.metric === chosen.metric);
  const censored = declared.some((one) => one.censored);
  const successes = declared.some((one) => one.both_succeeded);
  return (
    `${labels.metric_with_unit(data, chosen.metric)}, ${labels.direction_words(metric.direction)}; ` +
    `${
      test ? `${test.name}, two-sided` : rows[0].test
    }. Bars: 95 % intervals. Filled: the interval excludes 0, and p (Holm), corrected for all ` +
    `comparisons of this metric and factor in the scenario, is below ${SIGNIFICANT}. ` +
    'Effect: matched-pairs rank-biserial correlation, ' +
    `\u22121 to 1. Tasks: those ${successes ? 'in which both trials succeeded' : 'with values in both trials'}, ` +
    'each the mean over its crowds.' +
    (censored ? ' An incomplete trial counts with the time limit.' : '') +
    ` n: ${data.observation}s; below ${numbers.FEWEST} there is no p. ${labels.population(data)}`
  );
}

// The first metric with a significant difference, else with any.
export function default_metric(data) {
  const first = (holds) => (data.comparisons.find(holds) || {}).metric;
  return (
    first(is_sure) ||
    first((one) => one.mean_difference) ||
    data.comparisons[0].metric
  );
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  if (data.comparisons.some((one) => one.n >= numbers.FEWEST)) return null;
  if (data.comparisons.length > 0) return `no two combinations share ${numbers.FEWEST} ${data.observation}s`;
  return data.combinations.length < 2 ? 'there is one combination' : 'no two combinations share a trial';
}

export function mount(body, data) {
  const distinct = (key) => labels.distinct(data.comparisons.map((one) => one[key]));
  const variants = labels.variants(data);
  const chosen = {
    metric: default_metric(data),
    varied: distinct('varied').includes('local_controller') ? 'local_controller' : distinct('varied')[0],
    variant: controls.first_variant(variants, data.comparisons.length / distinct('metric').length),
  };
  const holder = element('div');
  const note = element('p', {class: 'note'});
  const show = () => {
    const rows = chosen_rows(data, chosen);
    fill(
      holder,
      rows.length > 0 ? table(data, rows, chosen) : element('p', {class: 'note'}, 'No comparison of these.')
    );
    fill(note, rows.length > 0 && note_words(data, rows, chosen));
  };
  const choose = (key) => (value) => {
    chosen[key] = value;
    show();
  };
  fill(
    body,
    controls.row(
      controls.select(
        'Metric',
        distinct('metric').map((name) => ({value: name, label: labels.metric_with_unit(data, name)})),
        chosen.metric,
        choose('metric')
      ),
      controls.segmented(
        'Between',
        distinct('varied').map((field) => ({
          value: field,
          label: labels.SHORT_TITLES[field].replace(/s?$/, 's'),
        })),
        chosen.varied,
        choose('varied')
      ),
      controls.variant_select(variants, chosen.variant, choose('variant'))
    ),
    holder,
    note
  );
  show();
}
