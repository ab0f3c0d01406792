// SPDX-License-Identifier: MIT
// chooser.js: selects the replayed trial: a combination, then one of its trials, with the reason for its replay.
import {element} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';

const row_of = (data, trial) => data.trials.id.indexOf(trial);
const combination_of = (data, trial) => data.trials.combination[row_of(data, trial)];

function combination_words(data, index) {
  const combination = data.combinations[index];
  const names = [combination.scenario];
  if (
    labels.distinct(data.combinations.map((one) => `${one.scenario}/${one.robots}`)).length >
    labels.distinct(data.combinations.map((one) => one.scenario)).length
  )
    names.push(numbers.counted(combination.robots, 'robot'));
  names.push(labels.combination(data, index));
  return names.join(' · ');
}

function trial_words(data, replay) {
  const row = row_of(data, replay.trial);
  return `trial ${replay.trial}: ${replay.why.join(', ')}, ${numbers.fixed(data.trials.sim_time_s[row], 1)} s`;
}

// A summary of a trial in one line.
export function trial_summary(data, replay) {
  const row = row_of(data, replay.trial);
  return [
    `Trial ${replay.trial}`,
    combination_words(data, data.trials.combination[row]),
    `seed ${data.trials.seed[row]}`,
    data.trials.outcome[row],
  ].join(' · ');
}

function labelled(title, box) {
  return element('label', {class: 'control'}, element('span', {}, title), box);
}

// Calls `choose` with the id of a trial.
export function make_chooser(data, choose) {
  const with_replays = labels
    .distinct(data.replays.map((replay) => combination_of(data, replay.trial)))
    .sort((a, b) => a - b);
  const combination_box = element(
    'select',
    {'data-testid': 'replay-combination'},
    with_replays.map((index) => element('option', {value: index}, combination_words(data, index)))
  );
  const trial_box = element('select', {'data-testid': 'replay-trial'});

  function fill_trials(combination) {
    trial_box.textContent = '';
    for (const replay of data.replays)
      if (combination_of(data, replay.trial) === combination)
        trial_box.append(element('option', {value: replay.trial}, trial_words(data, replay)));
  }

  combination_box.addEventListener('change', () => {
    fill_trials(Number(combination_box.value));
    choose(Number(trial_box.value));
  });
  trial_box.addEventListener('change', () => choose(Number(trial_box.value)));

  function show(trial) {
    combination_box.value = combination_of(data, trial);
    fill_trials(combination_of(data, trial));
    trial_box.value = trial;
  }

  const node = element(
    'div',
    {class: 'controls'},
    with_replays.length > 1 ? labelled('Combination', combination_box) : null,
    labelled('Trial', trial_box)
  );
  return {node, show};
}

// The rule that selected the trials; "" if the layout has none.
export function choice_words(data) {
  const rank_by = (data.layouts.report.replays || {rank_by: []}).rank_by;
  if (rank_by.length === 0) return '';
  const titles = rank_by.map((name) => labels.metric_title(data, name)).join(', or where that is undefined by ');
  const ranked = `the median and the worst trial by ${titles}`;
  return `For each combination: ${ranked}; then trials that failed or ended in a fault.`;
}

// One sentence for each kind of omitted replay.
export function left_out_words(data) {
  const kinds = {
    median: 'median trial',
    worst: 'worst trial',
    failure: 'failed trial',
    fault: 'trial with a fault',
    asked: 'requested trial',
  };
  return data.replays_left_out.map((one) => {
    const noun = kinds[one.why] || 'trial';
    return `${numbers.counted(one.trials, noun, noun.replace('trial', 'trials'))} without a replay: ${one.reason}.`;
  });
}
