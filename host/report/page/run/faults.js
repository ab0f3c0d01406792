// SPDX-License-Identifier: MIT
// faults.js: faults of plugins, with the command that reproduces each.
import * as controls from '../controls.js';
import {element, fill} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';

const SIGNALS = {
  4: 'SIGILL',
  6: 'SIGABRT',
  7: 'SIGBUS',
  8: 'SIGFPE',
  9: 'SIGKILL',
  11: 'SIGSEGV',
  15: 'SIGTERM',
  24: 'SIGXCPU',
};

function where_words(data, fault) {
  const row = data.trials.id.indexOf(fault.trial);
  const trial = row < 0 ? `trial ${fault.trial}` : `${labels.trial(data, row)} · seed ${data.trials.seed[row]}`;
  const signal = fault.signal !== null && (SIGNALS[fault.signal] || `signal ${fault.signal}`);
  return [trial, `step ${fault.step}`, fault.robot !== null && `robot ${fault.robot}`, signal]
    .filter(Boolean)
    .join(' · ');
}

function occurrence(data, fault) {
  return element(
    'div',
    {class: 'occurrence'},
    element('p', {class: 'where number'}, where_words(data, fault)),
    fault.detail && element('p', {class: 'detail-text'}, fault.detail),
    element(
      'div',
      {class: 'command'},
      element('code', {}, fault.rerun),
      controls.copy_button(fault.rerun, `the command that runs trial ${fault.trial} again`)
    )
  );
}

// Filled when unfolded, because there can be many.
function folded_rest(data, faults) {
  const made = element(
    'details',
    {class: 'more'},
    element('summary', {}, `${numbers.counted(faults.length, 'more occurrence', 'more occurrences')}`)
  );
  const unfold = () => {
    made.append(...faults.map((fault) => occurrence(data, fault)));
    made.removeEventListener('toggle', unfold);
  };
  made.addEventListener('toggle', unfold);
  return made;
}

function group_item(data, faults) {
  const [first, ...rest] = faults;
  return element(
    'li',
    {class: 'fault'},
    element(
      'h3',
      {},
      element('span', {class: 'kind'}, first.kind.replace(/_/g, ' ')),
      ` ${first.plugin}`,
      first.function && element('code', {}, ` ${first.function}()`)
    ),
    occurrence(data, first),
    rest.length > 0 && folded_rest(data, rest)
  );
}

// Groups faults of the same kind, plugin and function, in the order of their first occurrence.
export function groups(faults) {
  const found = new Map();
  for (const fault of faults) {
    const key = JSON.stringify([fault.kind, fault.plugin, fault.function]);
    if (!found.has(key)) found.set(key, []);
    found.get(key).push(fault);
  }
  return [...found.values()];
}

// "3 crash, 1 hang"
export function count_words(faults) {
  const kinds = labels.distinct(faults.map((fault) => fault.kind));
  return kinds
    .map((kind) => `${faults.filter((fault) => fault.kind === kind).length} ${kind.replace(/_/g, ' ')}`)
    .join(', ');
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.faults.length > 0 ? null : 'no plugin failed';
}

export function mount(body, data) {
  fill(
    body,
    element('p', {class: 'note'}, `${count_words(data.faults)}.`),
    element(
      'ul',
      {class: 'faults'},
      groups(data.faults).map((faults) => group_item(data, faults))
    )
  );
}
