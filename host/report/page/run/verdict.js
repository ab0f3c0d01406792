// SPDX-License-Identifier: MIT
// verdict.js: the verdict on a run: faults, missing trials, robots that did not arrive.
import * as numbers from '../numbers.js';

function sum(values) {
  return values.reduce((total, value) => total + (value || 0), 0);
}

// Robots that arrived, but do not count as arrived.
function excluded(data) {
  const causes = data.failures.flatMap((row) => row.causes).filter((one) => one.cause.startsWith('excluded for '));
  return sum(causes.map((one) => one.robots));
}

// Totals over all trials that ran. The layout names the metrics for arrivals and contacts.
export function tally(data) {
  const {trials, values, combinations, run} = data;
  const ran = trials.id.map((_, i) => i).filter((i) => trials.outcome[i] !== 'skipped');
  const robots = (i) => combinations[trials.combination[i]].robots;
  const {arrived, contacts} = data.layouts.summary;
  const known = (name) => ran.filter((i) => (values[name] || [])[i] !== null && (values[name] || [])[i] !== undefined);
  return {
    planned: run.trials_planned,
    ran: ran.length,
    missing: Math.max(0, run.trials_planned - ran.length),
    fault_trials: new Set(data.faults.map((fault) => fault.trial)).size,
    faults: data.faults.length,
    unsupported: ran.filter((i) => trials.outcome[i] === 'unsupported').length,
    failed_trials: ran.filter((i) => trials.outcome[i] === 'failed').length,
    not_repeatable: ran.filter((i) => !trials.repeatable[i]).length,
    robots: sum(known(arrived).map(robots)),
    arrived: Math.round(sum(known(arrived).map((i) => values[arrived][i] * robots(i)))) + excluded(data),
    excluded: excluded(data),
    contacts: known(contacts).length ? sum(known(contacts).map((i) => values[contacts][i])) : null,
    simulated_s: sum(ran.map((i) => trials.sim_time_s[i])),
    wall_s: sum(ran.map((i) => trials.wall_time_s[i])),
  };
}

function all_well(t) {
  if (t.robots === 0) return 'All is well: no faults, every trial repeatable.';
  const arrived = `${t.robots} of ${t.robots} robots arrived`;
  return t.contacts > 0
    ? `${arrived}, with ${numbers.counted(t.contacts, 'contact')}; no faults, every trial repeatable.`
    : `All is well: ${arrived}, no faults, every trial repeatable.`;
}

// ": 5 held behind another robot (by 1 robot), 2 stuck"
function causes_words(data) {
  return data.failures_line.slice(data.failures_line.indexOf(': '));
}

// Why trials are not repeatable: the plugins' reasons, each once.
function timing_words(data) {
  const reasons = new Set(data.timing.map(({plugin, reason}) => `${plugin}: ${reason}`));
  return reasons.size > 0 ? [...reasons].join('; ') : 'a wall-clock limit stopped a computation';
}

// [{kind: "bad"|"warning"|"note"|"good", text, section}], the worst first.
export function lines(data) {
  const t = tally(data);
  const found = [];
  const add = (kind, text, section = null) => found.push({kind, text, section});
  if (t.ran === 0) add('bad', 'No trial was run.');
  if (t.faults > 0)
    add(
      'bad',
      `${numbers.counted(t.faults, 'fault')} in ${numbers.counted(
        t.fault_trials,
        'trial'
      )}: the numbers below exclude the values that these trials lack.`,
      'faults'
    );
  if (t.missing > 0 && t.ran > 0)
    add(
      'bad',
      `${numbers.counted(t.missing, 'trial')} of ${t.planned} ${
        t.missing === 1 ? 'is' : 'are'
      } missing: the run is incomplete.`
    );
  if (data.growth_line) add('warning', data.growth_line);
  if (t.not_repeatable > 0)
    add(
      'warning',
      `${numbers.counted(t.not_repeatable, 'trial')} ${
        t.not_repeatable === 1 ? 'is' : 'are'
      } not repeatable bit by bit: ${timing_words(data)}.`
    );
  if (t.robots > 0 && t.arrived === 0)
    add('note', `No robot arrived: all ${t.robots} failed. Completion times are undefined.`, 'distributions');
  else if (t.arrived < t.robots)
    add(
      'note',
      `${numbers.counted(t.robots - t.arrived, 'robot')} of ${t.robots} did not arrive, in ${numbers.counted(
        t.failed_trials,
        'trial'
      )}${causes_words(data)}.`,
      'failures'
    );
  if (t.excluded > 0)
    add(
      'note',
      `${t.arrived} of ${t.robots} robots arrived; ${t.excluded} of them ${
        t.excluded === 1 ? 'is' : 'are'
      } excluded for oscillation.`,
      'failures'
    );
  if (t.unsupported > 0)
    add('note', `${numbers.counted(t.unsupported, 'trial')} left out: a plugin says that they are not for it.`);
  if (data.standstills_line) add('note', `${data.standstills_line}.`);
  if (found.length === 0) add('good', all_well(t));
  else if (t.ran > 0 && found.every((line) => line.kind === 'note'))
    add('good', `${numbers.counted(t.ran, 'trial')} without a fault, every one repeatable.`);
  return found;
}
