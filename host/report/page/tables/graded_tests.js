// SPDX-License-Identifier: MIT
// graded_tests.js: the level of each test that a combination passes half of the time, and the replays at each level.
import {element, fill, head_row} from '../elements.js';
import {open} from '../run/failures.js';
import {titled_table} from '../scroll_box.js';

const unit_of = (series) => (series.unit === '1' ? '' : ` (${series.unit})`);
const mean_words = (mean) => (mean === null ? '–' : mean.toFixed(2));

// Where there is one planner, the controller says it all.
function name_of(result, planners) {
  return planners > 1 ? `${result.global_planner} + ${result.local_controller}` : result.local_controller;
}

// A combination's trials at a level (its position), those that did not succeed first: they tell why it is the threshold.
export function trials_at(data, series, result, level) {
  const combination = data.combinations.findIndex(
    (one) =>
      one.scenario === series.scenarios[level] &&
      ['global_planner', 'local_controller', 'pedestrian_model'].every((field) => one[field] === result[field])
  );
  const rows = [...data.trials.combination.keys()].filter((row) => data.trials.combination[row] === combination);
  const failed = (row) => data.trials.outcome[row] !== 'succeeded';
  return [...rows.filter(failed), ...rows.filter((row) => !failed(row))].map((row) => data.trials.id[row]);
}

// The level next to the threshold on its easy side; the easiest one if not even that is passed.
export function level_of_threshold(result) {
  const passed = result.means.findIndex((mean) => mean !== null && mean >= 0.5);
  return passed === -1 ? result.means.length - 1 : passed;
}

function opener(data, series, result, level, text, note) {
  const trials = trials_at(data, series, result, level);
  if (trials.length === 0) return text;
  const title = `replay of ${series.scenarios[level]}`;
  return element('button', {type: 'button', class: 'count', title, onclick: () => open(data, {trials}, note)}, text);
}

function table_of(data, note, series, index) {
  const planners = new Set(series.results.map((result) => result.global_planner)).size;
  const rows = series.results.map((result) =>
    element(
      'tr',
      {},
      element('th', {scope: 'row'}, name_of(result, planners)),
      element('td', {class: 'number'}, opener(data, series, result, level_of_threshold(result), result.threshold, note)),
      result.means.map((mean, level) =>
        element('td', {class: 'number'}, opener(data, series, result, level, mean_words(mean), note))
      )
    )
  );
  const head = head_row(
    element('th', {scope: 'col'}, ''),
    element('th', {scope: 'col'}, 'passes half'),
    series.levels.map((level) => element('th', {scope: 'col', class: 'number'}, String(level)))
  );
  const legend = `${series.quantity}${unit_of(series)}, from hard to easy`;
  return titled_table(`graded-${index}`, series.title, legend, element('table', {}, head, element('tbody', {}, rows)));
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.graded.length > 0 ? null : 'no test has levels';
}

export function mount(body, data) {
  const note = element('p', {class: 'note', role: 'status'});
  fill(
    body,
    element('p', {class: 'note'}, 'A threshold or a share opens a replay at its level, if its trace was kept.'),
    note,
    data.graded.map((series, index) => table_of(data, note, series, index))
  );
}
