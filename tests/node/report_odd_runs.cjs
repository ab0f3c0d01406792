// SPDX-License-Identifier: MIT
// Reports of runs with failures: report_odd_runs.cjs SOURCE_FOLDER LIBRARY_OF_FAULTS. Each states the failure and shows
// the other results.
'use strict';
const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const {
  PHONE,
  browser_or_skip,
  run_experiment,
  scratch_folder,
  with_data,
  open_report,
  close,
  check_layout,
  run_tests,
} = require('./report_browser.cjs');

browser_or_skip();
const [source, library] = process.argv.slice(2);
const scratch = scratch_folder();
const crossing = fs.readFileSync(path.join(source, 'tests/end_to_end/crossing.toml'), 'utf8');
const world = fs.readFileSync(path.join(source, 'tests/end_to_end/worlds/crossing/scenario.toml'), 'utf8');

// Runs the crossing with `change` made to its experiment and `change_world` to its scenario.
function run(name, {change = (text) => text, change_world = (text) => text, ...options} = {}) {
  const folder = path.join(scratch, name);
  fs.mkdirSync(path.join(folder, 'worlds/crossing'), {recursive: true});
  fs.writeFileSync(path.join(folder, 'worlds/crossing/scenario.toml'), change_world(world));
  const experiment = path.join(folder, 'experiment.toml');
  fs.writeFileSync(experiment, change(crossing));
  return run_experiment(experiment, path.join(folder, 'run'), {
    env: {DMRP_SCENARIO_PATH: path.join(folder, 'worlds')},
    ...options,
  });
}

const without = (text, table) => text.replace(new RegExp(`\\[\\[${table}\\]\\]\\n(?:.+\\n)*\\n?`, 'g'), '');
const one_planner = (text) => `${without(text, 'global_planner')}\n[[global_planner]]\nuse = "dmrp.planner.cbs"\n`;
const one_controller = (text) =>
  `${without(text, 'local_controller')}\n[[local_controller]]\nuse = "dmrp.controller.dwa"\n`;

// Opens the report, passes its verdict and contents to `more`, and looks at it in both widths.
async function look(browser, report, more = async () => {}) {
  const opened = await open_report(browser, report);
  const {page} = opened;
  await check_layout(page, report);
  const verdict = await page.locator('.verdict').textContent();
  const contents = await page.locator('#contents a').allTextContents();
  const left_out = await page.locator('#left-out').textContent();
  await more({page, verdict, contents, left_out});
  await page.setViewportSize(PHONE);
  await check_layout(page, `${report} on a phone`);
  await close(opened);
}

const tests = {
  async 'no robot arrives'(browser) {
    const report = run('late', {change_world: (text) => text.replace(/time_limit_s = .*/, 'time_limit_s = 6.0')});
    await look(browser, report, async ({page, verdict}) => {
      assert.match(verdict, /No robot arrived: all 24 failed/);
      assert.strictEqual(
        await page.locator('.results td[data-about="defined in 0 of 3 trials"] .mean').first().textContent(),
        '—'
      );
      // a chosen trial opens two seconds before its first contact or failure, here at the time limit of 6 s or before
      await page.evaluate(() => dmrp.open_replay(dmrp.data.replays[0].trial));
      const opened_at = parseFloat(await page.getByTestId('replay-time').textContent());
      assert.ok(opened_at > 0 && opened_at <= 4, `opened at ${opened_at} s`);
    });
  },

  async 'one trial'(browser) {
    const report = run('one', {change: (text) => one_controller(one_planner(text)), options: ['--trials', '1']});
    await look(browser, report, async ({verdict, contents, left_out}) => {
      assert.match(verdict, /2 of 2 robots arrived.*no faults, every trial repeatable/);
      assert.ok(
        contents.includes('Every trial') &&
          !contents.includes('Planner by controller') &&
          !contents.includes('Correlations')
      );
      assert.match(left_out, /Planner by controller: there is one planner and one controller/);
      assert.match(left_out, /Paired differences: there is one combination/);
    });
  },

  async 'a single combination'(browser) {
    const report = run('single', {change: (text) => one_controller(one_planner(text))});
    await look(browser, report, async ({page, contents}) => {
      assert.ok(!contents.includes('Planner by controller'));
      assert.strictEqual(await page.locator('.results .best').count(), 0);
      assert.strictEqual(await page.locator('#distributions svg .mark.clickable').count(), 3);
    });
  },

  async 'a metric is undefined in one trial'(browser) {
    const report = with_data(run('undefined'), (data) => {
      const metric = data.layouts.report.distributions.metric;
      const arrived = data.values[data.layouts.summary.arrived];
      data.trials.id.forEach((_, i) => {
        data.trials.outcome[i] = i === 0 ? 'failed' : 'succeeded';
        arrived[i] = i === 0 ? 0.5 : 1;
        data.values[metric][i] = i === 0 ? null : 10 + i;
      });
      for (const [c, of] of data.summaries.entries())
        Object.assign(of[data.metrics.findIndex((one) => one.name === metric)], {
          defined: c === 0 ? 2 : 3,
          mean: 11 + c,
          low: 10,
          high: 20,
        });
    });
    await look(browser, report, async ({page, verdict}) => {
      assert.match(verdict, /1 robot of 24 did not arrive, in 1 trial/);
      assert.match(await page.locator('.results .partly').first().textContent(), /2\/3/);
      assert.match(await page.locator('#distributions .plot').textContent(), /undefined/);
      assert.strictEqual(await page.locator('#distributions svg .mark.failed.clickable').count(), 1);
    });
  },

  async 'plugins fail'(browser) {
    const faulty = (fault) =>
      `\n[[local_controller]]\nuse = "test.controller.faulty"\nlabel = "${fault}"\nparams = { fault = "${fault}" }\n`;
    const report = run('faults', {
      status: 1,
      change: (text) =>
        `${one_planner(text).replace('plugins = [', `plugins = ["${library}", `)}${faulty('crash')}${faulty('nan')}` +
        ['success', 'path_length', 'completion_time']
          .map((metric) => `\n[[metric]]\nuse = "dmrp.metric.${metric}"\n`)
          .join(''),
    });
    await look(browser, report, async ({page, verdict, contents}) => {
      assert.match(verdict, /6 faults in 6 trials/);
      assert.ok(contents.includes('Faults') && contents.includes('Results'));
      assert.strictEqual(await page.locator('#faults .fault').count(), 2);
      for (const more of await page.locator('#faults .more summary').all()) await more.click();
      await page.locator('#faults .occurrence').nth(5).waitFor();
      assert.strictEqual(await page.locator('#faults .occurrence').count(), 6);
      const crash = page.locator('#faults .fault', {hasText: 'crash'}).first();
      assert.match(
        await crash.textContent(),
        /test\.controller\.faulty.*trial \d+ · crossing.*step \d+ · robot \d+ · SIGSEGV/s
      );
      const command = await crash.locator('.command code').first().textContent();
      assert.match(command, /dmrp-host/);
      await crash.getByRole('button').first().click();
      await crash.getByText('Copied').waitFor();
    });
  },

  async 'an incomplete run'(browser) {
    const report = with_data(run('unfinished'), (data) => {
      data.run.trials_planned = 20;
      data.trials.repeatable[3] = false;
    });
    await look(browser, report, async ({verdict}) => {
      assert.match(verdict, /8 trials of 20 are missing/);
      assert.match(verdict, /1 trial is not repeatable/);
    });
  },

  async 'names that are markup stay text'(browser) {
    const report = run('markup', {
      change: (text) => text.replace('label = "together"', 'label = "<b>&amp;</b></script>"'),
    });
    await look(browser, report, async ({page}) => {
      assert.ok((await page.locator('.results').first().textContent()).includes('<b>&amp;</b></script>'));
    });
  },
};

run_tests(tests);
