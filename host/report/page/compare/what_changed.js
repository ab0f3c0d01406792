// SPDX-License-Identifier: MIT
// what_changed.js: in what the two runs differ: plugin libraries by their hashes, program, machine and settings.
import {element, fill, head_row} from '../elements.js';
import {titled_table} from '../scroll_box.js';

const DIGITS = 12; // of a hash

// 'same', 'changed', 'new' or 'missing'.
export function state_of(library) {
  if (library.before === null) return 'new';
  if (library.after === null) return 'missing';
  return library.before === library.after ? 'same' : 'changed';
}

function hash_cell(hash) {
  return element('td', {}, hash === null ? '—' : element('code', {class: 'hash', title: hash}, hash.slice(0, DIGITS)));
}

function libraries_table(run) {
  return element(
    'table',
    {class: 'files'},
    head_row(['plugin library', 'before', 'after', ''].map((text) => element('th', {scope: 'col'}, text))),
    element(
      'tbody',
      {},
      run.libraries.map((library) => {
        const state = state_of(library);
        return element(
          'tr',
          {class: state},
          element('th', {scope: 'row'}, library.name),
          hash_cell(library.before),
          hash_cell(library.after),
          element('td', {class: `judged ${state}`}, state)
        );
      })
    )
  );
}

export function mount(body, data, run) {
  const id = `libraries-${data.runs.indexOf(run)}`;
  fill(
    body,
    run.changes.length === 0
      ? element('p', {class: 'lead'}, 'Program, machine, plugin libraries and settings are the same.')
      : element(
          'ul',
          {class: 'answer-lines changes'},
          run.changes.map((change) => element('li', {}, change))
        ),
    run.libraries.length > 0 && titled_table(id, 'Plugin libraries', 'The first digits of the SHA-256 of each.', libraries_table(run))
  );
}
