// SPDX-License-Identifier: MIT
// few.js: takes out of a page's data what is estimated from too few pairs or values: its p cannot be below 5 %, and its
// interval is too narrow.
import {FEWEST} from './numbers.js';

const ESTIMATES =
  'difference median_difference mean_difference mean mean_s low high mean_low mean_high effect rho ties_share p p_holm';

// Where no pair differs (p_holm is null), that is a fact.
function clear(rows, count) {
  for (const row of rows)
    if (row[count] < FEWEST && row.p_holm !== null) for (const key of ESTIMATES.split(' ')) delete row[key];
}

// Of a report or of a comparison of runs.
export function without_estimates(data) {
  const {comparisons = [], correlations = [], pedestrian_delay = [], answers = [], runs = []} = data;
  clear([...comparisons, ...pedestrian_delay], 'pairs');
  clear(correlations, 'n');
  clear(answers.flatMap(({ranking}) => ranking.flatMap((one) => one.against)), 'observations');
  clear(runs.flatMap((run) => [run.differences, run.of_combinations].flat(2)), 'seeds');
  return data;
}
