// SPDX-License-Identifier: MIT
// Checks the order of the rooms of the report's page, from esbuild's list of imports: page_rooms.cjs PAGE_FOLDER.
'use strict';
const assert = require('node:assert');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

// Lowest first: a module imports from its own room and from those before it. The pages' starts import from all of them.
const STARTS = ['start.js', 'start_compare.js'];
const ORDER = ['.', 'run', 'plots', 'tables', 'replay', 'replay_3d', 'compare', ...STARTS];

const is_own = (file) => !path.isAbsolute(file) && !file.startsWith('..') && file.endsWith('.js');
const room_of = (file) => (STARTS.includes(file) ? file : path.dirname(file));

// inputs: {file: [files that it imports]}. Returns the breaches as text.
function breaches(inputs) {
  const found = [];
  const rank = (file) => ORDER.indexOf(room_of(file));
  for (const [file, imports] of Object.entries(inputs)) {
    if (rank(file) < 0) found.push(`${file}: the room ${room_of(file)} is not listed in ORDER`);
    for (const other of imports)
      if (rank(other) > rank(file)) found.push(`${file} imports ${other}, of a room above it`);
  }
  return [...found, ...cycles(inputs)];
}

function cycles(inputs) {
  const found = [];
  const state = new Map();
  const visit = (file, way) => {
    if (state.get(file) === 'open') found.push(`a cycle: ${[...way.slice(way.indexOf(file)), file].join(' > ')}`);
    if (state.has(file)) return;
    state.set(file, 'open');
    for (const other of inputs[file] || []) visit(other, [...way, file]);
    state.set(file, 'done');
  };
  for (const file of Object.keys(inputs)) visit(file, []);
  return found;
}

function read_imports(folder) {
  const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'dmrp-rooms-'));
  try {
    const account = path.join(scratch, 'meta.json');
    execFileSync(
      process.env.DMRP_ESBUILD,
      [...STARTS, '--bundle', '--log-level=warning', `--metafile=${account}`, `--outdir=${scratch}`],
      {cwd: folder, env: {...process.env, NODE_PATH: process.env.DMRP_D3_MODULES}, stdio: 'inherit'}
    );
    const inputs = {};
    for (const [file, {imports}] of Object.entries(JSON.parse(fs.readFileSync(account, 'utf8')).inputs))
      if (is_own(file)) inputs[file] = imports.map((one) => one.path).filter(is_own);
    return inputs;
  } finally {
    fs.rmSync(scratch, {recursive: true, force: true});
  }
}

// the check itself
assert.deepStrictEqual(breaches({'a.js': [], 'plots/a.js': ['a.js', 'plots/b.js'], 'plots/b.js': []}), []);
assert.strictEqual(breaches({'plots/a.js': ['tables/a.js'], 'tables/a.js': []}).length, 1);
assert.strictEqual(breaches({'a.js': ['b.js'], 'b.js': ['a.js']}).length, 1);
assert.strictEqual(breaches({'cellar/a.js': []}).length, 1);

const inputs = read_imports(process.argv[2]);
const sources = fs
  .readdirSync(process.argv[2], {recursive: true})
  .map(String)
  .filter((file) => file.endsWith('.js'));
const unused = sources.filter((file) => !(file in inputs)).map((file) => `${file} is imported by nothing`);
const found = [...breaches(inputs), ...unused];
for (const breach of found) console.error(breach);
console.log(`${Object.keys(inputs).length} modules, ${found.length} breaches`);
process.exit(found.length > 0 ? 1 : 0);
