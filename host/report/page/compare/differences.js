// SPDX-License-Identifier: MIT
// differences.js: paired differences between two runs, after minus before: of each metric over all trials, and of one
// metric for each combination.
import * as controls from '../controls.js';
import {bodies_of, element, fill, head_row, number_head} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {scroll_box} from '../scroll_box.js';
import * as interval_rows from '../tables/interval_rows.js';
import * as judgement from './judgement.js';

const estimate_of = ({difference, low, high}) => ({estimate: difference, low, high});

// The cells that all differences have, behind the name and the picture of the interval.
function cells(data, difference) {
  const digits = judgement.decimals(data, difference);
  const number = (label, ...content) => element('td', {class: 'number', 'data-label': label}, content);
  const judged = judgement.of(data, difference);
  return [
    number('before', numbers.fixed(difference.before, digits)),
    number('after', numbers.fixed(difference.after, digits)),
    interval_rows.difference_cell('difference', estimate_of(difference), digits),
    number('p (Holm)', numbers.p_value(difference.p_holm)),
    number('n', `${difference.n}`),
    element('td', {class: `judged ${judged}`}, judgement.WORDS[judged]),
  ];
}

const HEADS = ['before', 'after', 'difference', 'p (Holm)', 'n'];

function metrics_table(data, run) {
  const rows = run.differences.map((difference) => {
    const {description, direction} = labels.metric(data, difference.metric);
    const about = `${description} (${labels.direction_words(direction)})`;
    const name = element('span', {'data-about': about, tabindex: '0'}, labels.metric_with_unit(data, difference.metric));
    return element('tr', {}, element('th', {scope: 'row'}, name), cells(data, difference));
  });
  return element(
    'table',
    {class: 'forest with-intervals'},
    head_row(element('th', {scope: 'col'}, 'metric'), HEADS.map((head) => number_head(head)), element('th', {scope: 'col'}, '')),
    element('tbody', {}, rows)
  );
}

export function mount_metrics(body, data, run) {
  fill(
    body,
    scroll_box({'aria-label': 'Differences over all trials'}, metrics_table(data, run)),
    element(
      'p',
      {class: 'note'},
      'Means over the n tasks, or crowds of listed tasks, that both runs have. Difference: after minus before, in pairs, with its 95 % interval; ' +
        'all trials of one count together. p (Holm): corrected for the number of metrics; ' +
        'better, worse and changed are below 0.05. A trial that ended in a fault failed, the time of a failed trial is ' +
        'the time limit, lengths are compared where both trials succeeded.'
    )
  );
}

// The data as the modules of a report expect them: with the combinations of this comparison.
export function with_combinations(data, run) {
  return {...data, combinations: run.combinations};
}

// The metric that differs in most combinations, else the first.
export function default_metric(data, run) {
  const clear = (index) =>
    run.of_combinations.filter((of) => ['better', 'worse', 'changed'].includes(judgement.of(data, of[index]))).length;
  const counts = run.differences.map((_, index) => clear(index));
  return counts.indexOf(Math.max(...counts));
}

function combinations_table(data, run, index) {
  const own = run.of_combinations.map((of) => of[index]);
  const x = interval_rows.scale(own.map(estimate_of));
  const row_of = (combination) => {
    const difference = own[combination];
    const sure = ['better', 'worse', 'changed'].includes(judgement.of(data, difference));
    return element(
      'tr',
      {class: sure ? 'sure' : null},
      element('th', {scope: 'row'}, labels.combination(data, combination)),
      interval_rows.cell(estimate_of(difference), x, sure),
      cells(data, difference)
    );
  };
  const made = element(
    'table',
    {class: 'forest with-intervals'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      interval_rows.axis(x, '', ''),
      HEADS.map((head) => number_head(head)),
      element('th', {scope: 'col'}, '')
    ),
    bodies_of(data, labels.variants(data), 8, (variant) => variant.combinations.map(row_of))
  );
  return scroll_box({'aria-label': 'Differences by combination'}, made);
}

export function mount_combinations(body, whole, run) {
  const data = with_combinations(whole, run);
  const holder = element('div');
  const note = element('p', {class: 'note'});
  const show = (index) => {
    const {direction, description, name} = labels.metric(data, run.differences[index].metric);
    fill(holder, combinations_table(data, run, index));
    fill(
      note,
      `${labels.metric_with_unit(data, name)}: ${description}; ${labels.direction_words(direction)}. Bars: 95 % ` +
        'intervals. Filled: p (Holm) below 0.05, corrected for the number of combinations.'
    );
  };
  const first = default_metric(data, run);
  show(first);
  const options = run.differences.map((one, index) => ({
    value: String(index),
    label: labels.metric_with_unit(data, one.metric),
  }));
  fill(
    body,
    controls.row(controls.select('Metric', options, String(first), (value) => show(Number(value)))),
    holder,
    note
  );
}
