// SPDX-License-Identifier: MIT
// page_modules.cjs: loads modules of the report's page into node, bundled by esbuild as for a browser.
'use strict';
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

// page_modules(folder of the page, {name: 'room/file.js'}): {name: the module}. esbuild and the folder of d3's modules
// come from the build's configuration, by DMRP_ESBUILD and DMRP_D3_MODULES.
function page_modules(folder, files) {
  const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'dmrp-page-'));
  try {
    const bundle = path.join(scratch, 'page.cjs');
    const entry = Object.entries(files).map(([name, file]) => `export * as ${name} from './${file}';`);
    execFileSync(
      process.env.DMRP_ESBUILD,
      [
        '--bundle',
        '--format=cjs',
        '--platform=node',
        '--main-fields=module,main',
        '--log-level=warning',
        `--outfile=${bundle}`,
      ],
      {
        cwd: folder,
        env: {...process.env, NODE_PATH: process.env.DMRP_D3_MODULES},
        input: entry.join('\n'),
        stdio: ['pipe', 'inherit', 'inherit'],
      }
    );
    return require(bundle);
  } finally {
    fs.rmSync(scratch, {recursive: true, force: true});
  }
}

module.exports = {page_modules};
