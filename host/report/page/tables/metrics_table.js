// SPDX-License-Identifier: MIT
// metrics_table.js: all metrics of one combination, with units, directions and descriptions.
import * as controls from '../controls.js';
import {element, fill, head_row, hidden, number_cell} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {scroll_box} from '../scroll_box.js';
import {explained_mark} from '../tips.js';

const state = {combination: 0, words: '', changed: () => {}};
const BETTER = {higher: '↑', lower: '↓', none: ''};

// Metrics whose name, description or unit contains all words. Curves are shown in another section.
export function found(data, words) {
  const wanted = words.toLowerCase().split(/\s+/).filter(Boolean);
  return data.metrics
    .map((metric, i) => i)
    .filter((i) => {
      const metric = data.metrics[i];
      const text = `${metric.name} ${metric.name.replace(/_/g, ' ')} ${metric.description} ${
        metric.unit
      }`.toLowerCase();
      return metric.name in data.values && wanted.every((word) => text.includes(word));
    });
}

function row(metric, summary, trials) {
  const decimals = numbers.decimals_of([summary.mean, summary.low, summary.high, summary.median]);
  const number = (label, ...content) => element('td', {class: 'number', 'data-label': label}, content);
  const show = (value) => numbers.fixed(value, decimals);
  return element(
    'tr',
    {},
    element(
      'th',
      {scope: 'row', class: 'about'},
      element('span', {class: 'name'}, metric.name),
      metric.wall_clock && element('span', {class: 'tag'}, 'clock time: differs from run to run'),
      element('span', {class: 'description'}, metric.description)
    ),
    element('td', {class: 'unit-cell', 'data-label': 'unit'}, numbers.unit(metric.unit) || '\u2013'),
    element(
      'td',
      {class: 'better', 'data-label': 'better', 'data-about': labels.direction_words(metric.direction)},
      BETTER[metric.direction],
      hidden(labels.direction_words(metric.direction))
    ),
    number_cell('mean', show(summary.mean), numbers.none_of(summary) || numbers.interval(summary.low, summary.high, decimals)),
    number('sd', show(summary.sd)),
    number('median', show(summary.median)),
    number('defined', `${summary.defined}/${trials}`),
    number(
      'paper\u2019s rule',
      show(summary.paper_mean),
      ` (${summary.paper_count})`,
      summary.paper_trimmed_all_nonzero &&
        explained_mark('†', 'the rule removed every value that is not zero', {class: 'flag'})
    )
  );
}

function head() {
  const columns = [
    ['metric', 'about'],
    ['unit', ''],
    ['better', ''],
    ['mean', 'number'],
    ['sd', 'number'],
    ['median', 'number'],
    ['defined', 'number'],
    ['paper\u2019s rule', 'number'],
  ];
  return head_row(columns.map(([text, kind]) => element('th', {scope: 'col', class: kind}, text)));
}

function combination_options(data) {
  return labels.variants(data).flatMap((variant) =>
    variant.combinations.map((i) => ({
      value: String(i),
      label: `${variant.label} · ${labels.combination(data, i)}`,
    }))
  );
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.combinations.length > 0 ? null : 'no trial was run';
}

export function mount(body, data) {
  const options = combination_options(data);
  if (!options.some((option) => option.value === String(state.combination)))
    state.combination = Number(options[0].value);
  const rows = element('tbody');
  const count = element('p', {class: 'note', role: 'status'});
  const title = element('h3', {id: 'title-metrics'});
  state.changed = () => {
    const trials = data.trials.combination.filter(
      (of, i) => of === state.combination && !['skipped', 'unsupported'].includes(data.trials.outcome[i])
    ).length;
    const shown = found(data, state.words);
    fill(
      rows,
      shown.map((i) => row(data.metrics[i], data.summaries[state.combination][i], trials))
    );
    fill(count, state.words ? `${numbers.counted(shown.length, 'metric')} found.` : '');
    fill(title, options.find((option) => option.value === String(state.combination)).label);
    const box = body.querySelector('select');
    if (box) box.value = String(state.combination);
  };
  fill(
    body,
    controls.row(
      controls.select('Combination', options, String(state.combination), (value) => {
        state.combination = Number(value);
        state.changed();
      }),
      controls.search('Search metrics', (words) => {
        state.words = words;
        state.changed();
      })
    ),
    title,
    scroll_box(
      {class: 'tall', 'aria-labelledby': 'title-metrics'},
      element('table', {class: 'metrics with-intervals', 'aria-labelledby': 'title-metrics'}, head(), rows)
    ),
    count,
    element(
      'p',
      {class: 'note'},
      'sd and median are over trials. † the paper\u2019s rule removed every value that is not zero.'
    )
  );
  state.changed();
}

// Shows a combination; the links of the result tables call it.
export function show(combination) {
  state.combination = combination;
  state.changed();
}
