// SPDX-License-Identifier: MIT
// graded_tests.js: the level of each test that a combination passes half of the time.
import {element, fill, head_row} from '../elements.js';
import {titled_table} from '../scroll_box.js';

const unit_of = (series) => (series.unit === '1' ? '' : ` (${series.unit})`);
const mean_words = (mean) => (mean === null ? '–' : mean.toFixed(2));

// Where there is one planner, the controller says it all.
function name_of(result, planners) {
  return planners > 1 ? `${result.global_planner} + ${result.local_controller}` : result.local_controller;
}

function table_of(series, index) {
  const planners = new Set(series.results.map((result) => result.global_planner)).size;
  const rows = series.results.map((result) =>
    element(
      'tr',
      {},
      element('th', {scope: 'row'}, name_of(result, planners)),
      element('td', {class: 'number'}, result.threshold),
      result.means.map((mean) => element('td', {class: 'number'}, mean_words(mean)))
    )
  );
  const head = head_row(
    element('th', {scope: 'col'}, ''),
    element('th', {scope: 'col'}, 'passes half'),
    series.levels.map((level) => element('th', {scope: 'col', class: 'number'}, String(level)))
  );
  const note = series.tells_apart
    ? `${series.quantity}${unit_of(series)}, from hard to easy`
    : `${series.quantity}${unit_of(series)}, from hard to easy. Sanity only: no level has a mean in [0.2, 0.8]`;
  return titled_table(`graded-${index}`, series.title, note, element('table', {}, head, element('tbody', {}, rows)));
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.graded.length > 0 ? null : 'no test has levels';
}

export function mount(body, data) {
  fill(body, data.graded.map(table_of));
}
