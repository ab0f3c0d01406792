// SPDX-License-Identifier: MIT
// provenance.js: software, machine and files behind the results, and the command that reproduces them.
import * as controls from '../controls.js';
import {element, fill, head_row} from '../elements.js';
import {titled_table} from '../scroll_box.js';
import * as overview from './overview.js';

// Quotes an argument for a POSIX shell.
function quoted(argument) {
  return /^[\w./:=,@%+-]+$/.test(argument) ? argument : `'${argument.replace(/'/g, `'\\''`)}'`;
}

// The command line that gives all the trials that the run has: it may have grown since it was begun.
export function whole_run(run) {
  const grown = ((run.manifest || {}).experiment || {}).grown_from || [];
  if (grown.length === 0) return run.command_line;
  const is_number = (i) => /^--trials(=|$)/.test(run.command_line[i]) || run.command_line[i - 1] === '--trials';
  return [...run.command_line.filter((_, i) => !is_number(i)), '--trials', String(run.repetitions)];
}

export function command_words(command_line) {
  return command_line.map(quoted).join(' ');
}

function facts(data) {
  const {run} = data;
  const machine = run.manifest.machine || {};
  const pairs = [
    ['dmrp', `${run.version}${run.manifest.abi ? `, plugin ABI ${run.manifest.abi}` : ''}`],
    ['started', overview.date_words(run.started)],
    ['compiler', machine.compiler],
    ['C library', machine.libc],
    ['processor', machine.cpu_level],
    ['seed', run.seed],
    ['protocol (tasks and rules, without the entries)', (run.manifest.protocol || '').slice(0, 16)],
  ].filter(([, value]) => value);
  return element(
    'dl',
    {class: 'choices facts'},
    pairs.map(([title, value]) => [element('dt', {}, title), element('dd', {}, value)])
  );
}

function files(data) {
  const all = data.run.manifest.files || [];
  if (all.length === 0) return null;
  return titled_table(
    'title-files',
    'Input files',
    null,
    element(
      'table',
      {class: 'files'},
      head_row(['role', 'path', 'SHA-256'].map((text) => element('th', {scope: 'col'}, text))),
      element(
        'tbody',
        {},
        all.map((file) =>
          element(
            'tr',
            {},
            element('th', {scope: 'row'}, file.role),
            element('td', {}, element('code', {}, file.path)),
            element('td', {}, element('code', {class: 'hash'}, file.sha256))
          )
        )
      )
    )
  );
}

function command(text, what) {
  return element('div', {class: 'command'}, element('code', {}, text), controls.copy_button(text, what));
}

function repeating(data) {
  const line = command_words(whole_run(data.run));
  return element(
    'div',
    {class: 'repeating'},
    element('h3', {}, 'Reproduce this run'),
    element('p', {}, 'Command line of the run:'),
    command(line, 'the command line'),
    element(
      'p',
      {},
      'effective.toml, below and in the run directory, is the experiment with all defaults filled in. With the same ' +
        'plugin libraries, C library and processor level it reproduces every value but clock times bit by bit:'
    ),
    command('dmrp-host effective.toml', 'the command that repeats the run')
  );
}

function folded(title, text) {
  return element(
    'details',
    {class: 'folded'},
    element('summary', {}, title),
    controls.copy_button(text, title),
    element('pre', {tabindex: '0'}, element('code', {}, text))
  );
}

export function mount(body, data) {
  fill(
    body,
    facts(data),
    repeating(data),
    folded('effective.toml', data.run.effective_toml),
    folded('manifest.json', JSON.stringify(data.run.manifest, null, 2)),
    files(data)
  );
}
