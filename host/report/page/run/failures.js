// SPDX-License-Identifier: MIT
// failures.js: why robots failed: a table of combinations and causes, with the trials behind each count.
import {element, fill, group_row, head_row, titled_table} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';

// The causes of all combinations, the most frequent first; contacts of robots that arrived come last.
export function causes(data) {
  const robots = new Map();
  for (const row of data.failures)
    for (const one of row.causes) robots.set(one.cause, (robots.get(one.cause) || 0) + one.robots);
  const found = [...robots.keys()].sort((a, b) => robots.get(b) - robots.get(a));
  return data.failures.some((row) => row.contact.robots > 0) ? [...found, 'contact'] : found;
}

function cell_of(row, cause) {
  if (cause === 'contact') return row.contact;
  return row.causes.find((one) => one.cause === cause) || {cause, robots: 0, trials: []};
}

// The trial to open for a cause: one that the page can replay, else the first.
export function trial_to_open(data, cell) {
  const replays = new Set(data.replays.map((replay) => replay.trial));
  const trial = cell.trials.find((one) => replays.has(one));
  return trial === undefined ? {trial: cell.trials[0], replayed: false} : {trial, replayed: true};
}

function open(data, cell, note) {
  const {trial, replayed} = trial_to_open(data, cell);
  if (replayed) {
    document.dispatchEvent(new CustomEvent('dmrp:open-replay', {detail: trial}));
    return;
  }
  note.textContent =
    `Trials ${cell.trials.join(', ')}: not in this page. "dmrp-host report RUN_DIR --replay ${trial}" adds the replay, ` +
    'if the run kept its trace.';
}

function count_element(data, cell, note) {
  if (cell.robots === 0) return element('td', {class: 'number none'}, '\u2013');
  const title = `${numbers.counted(cell.trials.length, 'trial')}: ${cell.trials.slice(0, 8).join(', ')}${
    cell.trials.length > 8 ? ', …' : ''
  }`;
  return element(
    'td',
    {class: 'number'},
    element('button', {type: 'button', class: 'count', title, onclick: () => open(data, cell, note)}, String(cell.robots))
  );
}

function row_element(data, row, columns, note) {
  const failed = row.causes.reduce((sum, one) => sum + one.robots, 0);
  const fields = labels.naming_fields(data);
  return element(
    'tr',
    {},
    element('th', {scope: 'row'}, fields.map((field) => labels.named(row.combination[field])).join(' + ')),
    element('td', {class: 'number'}, `${failed} of ${row.robots}`),
    columns.map((cause) => count_element(data, cell_of(row, cause), note))
  );
}

export function mount(body, data) {
  const columns = causes(data);
  if (columns.length === 0) return 'every robot arrived, without a contact at its fault';
  const note = element('p', {class: 'note', role: 'status'});
  const bodies = labels.variants(data).map((variant) => {
    const rows = data.failures.filter(
      (row) => labels.is_of(variant.scenario, row.combination) && (row.causes.length > 0 || row.contact.robots > 0)
    );
    if (rows.length === 0) return null;
    return element(
      'tbody',
      {},
      data.scenarios.length > 1 && group_row(variant.label, columns.length + 2),
      rows.map((row) => row_element(data, row, columns, note))
    );
  });
  const table = element(
    'table',
    {class: 'failures'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      element('th', {scope: 'col', class: 'number'}, 'did not arrive'),
      columns.map((cause) => element('th', {scope: 'col', class: 'number'}, cause))
    ),
    bodies
  );
  fill(
    body,
    titled_table('title-failures', 'Causes', null, table),
    element(
      'p',
      {class: 'note'},
      'Numbers of robots; a number opens the replay of such a trial. Contact: robots that arrived, but touched somebody ' +
        'or something by their own fault. Combinations without either are left out.'
    ),
    note
  );
  return null;
}
