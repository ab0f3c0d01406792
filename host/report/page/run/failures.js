// SPDX-License-Identifier: MIT
// failures.js: why robots failed: a table of combinations and causes, with the trials behind each count; and how many
// robots arrived of each type, where there are several.
import {bodies_of, element, fill, head_row} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {titled_table} from '../scroll_box.js';

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

// Opens the replay of one of these trials, or notes how to get it.
export function open(data, cell, note) {
  const {trial, replayed} = trial_to_open(data, cell);
  if (replayed) {
    document.dispatchEvent(new CustomEvent('dmrp:open-replay', {detail: trial}));
    return;
  }
  note.textContent =
    `Trials ${cell.trials.join(', ')}: not in this page. "dmrp-host report RUN_DIR --replay ${trial}" adds the replay, ` +
    'if the run kept its trace.';
}

// "9 (by 2 robots; 3 after a contact)"
export function count_words(cell) {
  const more = [
    cell.roots > 0 && `by ${numbers.counted(cell.roots, 'robot')}`,
    cell.after_contact > 0 && `${cell.after_contact} after a contact`,
  ].filter(Boolean);
  return more.length > 0 ? `${cell.robots} (${more.join('; ')})` : String(cell.robots);
}

function count_element(data, cell, note) {
  if (cell.robots === 0) return element('td', {class: 'number none'}, '\u2013');
  const title = `${numbers.counted(cell.trials.length, 'trial')}: ${cell.trials.slice(0, 8).join(', ')}${
    cell.trials.length > 8 ? ', …' : ''
  }`;
  return element(
    'td',
    {class: 'number'},
    element('button', {type: 'button', class: 'count', title, onclick: () => open(data, cell, note)}, count_words(cell))
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

// Robots that arrived, by combination and type; null if all robots are of one type.
function arrivals_by_type(data) {
  const types = [...new Set(data.arrivals_by_type.flatMap((row) => row.types.map((one) => one.type)))];
  if (types.length === 0) return null;
  const fields = [...(data.scenarios.length > 1 ? ['scenario'] : []), ...labels.naming_fields(data)];
  const table = element(
    'table',
    {class: 'failures'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      types.map((type) => element('th', {scope: 'col', class: 'number'}, type))
    ),
    element(
      'tbody',
      {},
      data.arrivals_by_type.map((row) =>
        element(
          'tr',
          {},
          element('th', {scope: 'row'}, fields.map((field) => labels.named(row.combination[field])).join(' + ')),
          types.map((type) => {
            const one = row.types.find((of_row) => of_row.type === type);
            return element('td', {class: 'number'}, one ? `${one.arrived} of ${one.robots}` : '\u2013');
          })
        )
      )
    )
  );
  return titled_table('title-arrivals-by-type', 'Robots that arrived, by type', null, table);
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return causes(data).length > 0 || arrivals_by_type(data) !== null
    ? null
    : 'every robot arrived, without a contact at its fault';
}

export function mount(body, data) {
  const columns = causes(data);
  const by_type = arrivals_by_type(data);
  if (columns.length === 0) {
    fill(body, element('p', {class: 'note'}, 'Every robot arrived, without a contact at its fault.'), by_type);
    return;
  }
  const note = element('p', {class: 'note', role: 'status'});
  const failed = data.failures.filter((row) => row.causes.length > 0 || row.contact.robots > 0);
  const bodies = bodies_of(data, labels.variants(data), columns.length + 2, (variant) =>
    failed
      .filter((row) => labels.is_of(variant.scenario, row.combination))
      .map((row) => row_element(data, row, columns, note))
  );
  const table = element(
    'table',
    {class: 'failures'},
    head_row(
      element('th', {scope: 'col'}, 'combination'),
      element('th', {scope: 'col', class: 'number'}, 'failed'),
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
      'Numbers of robots; a number opens the replay of such a trial. Roots: the robots that hold or block these, ' +
        'through all that wait. Contact: robots that arrived, but touched somebody or something by their own fault. ' +
        'Combinations without either are left out.'
    ),
    note,
    by_type
  );
}
