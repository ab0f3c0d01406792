// SPDX-License-Identifier: MIT
// The page of `compare --report` in a browser: compare_page.cjs SOURCE_FOLDER. What became worse or better is known.
'use strict';
const assert = require('node:assert');
const {spawnSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {
  PHONE,
  browser_or_skip,
  run_experiment,
  scratch_folder,
  with_data,
  open_report,
  shared_report,
  close,
  check_layout,
  run_tests,
} = require('./report_browser.cjs');

browser_or_skip();
const [source] = process.argv.slice(2);
const scratch = scratch_folder();

// Two runs of the crossing; in the second, robots of pure pursuit slow down long before their goals, and more arrive.
function compared() {
  const crossing = fs
    .readFileSync(path.join(source, 'tests/end_to_end/crossing.toml'), 'utf8')
    .replace('use = "crossing"', '$&\nstart_jitter = { position_m = 0.02 }');
  const env = {DMRP_SCENARIO_PATH: path.join(source, 'tests/end_to_end/worlds')};
  const run = (name, text) => {
    const experiment = path.join(scratch, `${name}.toml`);
    fs.writeFileSync(experiment, text);
    run_experiment(experiment, path.join(scratch, name), {env, options: ['--trials', '14']});
    return path.join(scratch, name);
  };
  const before = run('before', crossing);
  const after = run(
    'after',
    crossing.replace('use = "dmrp.controller.pure_pursuit"', '$&\nparams = { approach_velocity_scaling_dist = 10.0 }')
  );
  const page = path.join(scratch, 'compared.html');
  const made = spawnSync(process.env.DMRP_HOST, ['compare', before, after, '--report', page], {encoding: 'utf8'});
  assert.strictEqual(made.status, 0, made.stderr);
  return page;
}

const page_of_both = compared();
const last = '#run-0-2.ready';

const cells = (row) => row.locator('td').allTextContents();

const tests = {
  async 'fits a laptop and a phone, light and dark'(browser) {
    for (const viewport of [undefined, PHONE])
      for (const colorScheme of ['light', 'dark']) {
        const opened = await shared_report(browser, page_of_both, {viewport, colorScheme, last});
        await check_layout(opened.page, 'the comparison');
        await close(opened);
      }
  },

  async 'says that more robots arrive, and with which controller'(browser) {
    const opened = await shared_report(browser, page_of_both, {last});
    const {page} = opened;
    assert.match(await page.locator('.verdict').textContent(), /Better over all trials:.*; success \+0\.50.*completion time \u2212/);
    await page.getByLabel('Metric').selectOption({label: 'completion time (s)'});
    const rows = page.locator('#run-0-1 tbody tr:not(.group)');
    for (const row of await rows.all()) {
      const name = await row.locator('th').textContent();
      const [, , , , , , judged] = await cells(row);
      assert.strictEqual(judged, /Pure pursuit/i.test(name) ? 'better' : 'equal', name);
    }
    assert.strictEqual(await rows.count(), 4);
    assert.match(await page.locator('#run-0-2').textContent(), /approach_velocity_scaling_dist/);
    for (const state of await page.locator('#run-0-2 .files .judged').allTextContents()) assert.strictEqual(state, 'same');
    await close(opened);
  },

  async 'shows what the data say: exchanged runs, another library'(browser) {
    const exchanged = with_data(page_of_both, (data) => {
      const [run] = data.runs;
      for (const one of [...run.differences, ...run.of_combinations.flat()]) {
        [one.before, one.after] = [one.after, one.before];
        one.difference = -one.difference;
        [one.low, one.high] = [-one.high, -one.low];
      }
      run.libraries[0].after = 'f'.repeat(64);
    });
    const opened = await open_report(browser, exchanged, {last});
    assert.match(await opened.page.locator('.verdict').textContent(), /Worse over all trials:.*completion time \+/);
    assert.deepStrictEqual(
      (await opened.page.locator('#run-0-2 .files .judged').allTextContents()).filter((state) => state !== 'same'),
      ['changed']
    );
    assert.match(await opened.page.locator('#run-0-2 .files tr.changed').textContent(), /ffffffffffff/);
    await close(opened);
  },

  async 'cautions where tasks are few or trials have no partner'(browser) {
    const few = with_data(page_of_both, (data) => {
      for (const one of data.runs[0].differences) Object.assign(one, {n: 3, p: null, p_holm: null, equal: false, difference: 0.123});
      data.runs[0].only_before = 2;
    });
    const opened = await open_report(browser, few, {last});
    const verdict = await opened.page.locator('.verdict').textContent();
    assert.match(verdict, /No metric differs significantly/);
    assert.match(verdict, /n = 3: no difference is significant with fewer than 5/);
    for (const row of await opened.page.locator('#run-0 tbody tr').all())
      assert.match((await cells(row)).slice(3, 5).join(), /^—,3$/);
    assert.match(verdict, /2 trials without a partner \(2 before, 0 after\)/);
    await close(opened);
  },
};

run_tests(tests);
