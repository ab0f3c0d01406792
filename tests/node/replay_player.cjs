// SPDX-License-Identifier: MIT
// The replay in a browser: replay_player.cjs PROJECT.
'use strict';
const assert = require('node:assert');
const path = require('node:path');
const {run_experiment, scratch_folder, open_report, run_tests} = require('./report_browser.cjs');

const {page_modules} = require('./page_modules.cjs');

const project = process.argv[2];
const {recording} = page_modules(path.join(project, 'host/report/page'), {recording: 'replay/recording.js'});
const report = run_experiment(path.join(project, 'examples/quickstart.toml'), path.join(scratch_folder(), 'run'));

async function open_replay(browser, options = {}) {
  const opened = await open_report(browser, report, options);
  await opened.page.evaluate(() => dmrp.open_replay(dmrp.data.replays[0].trial));
  await opened.page.locator('#replay[data-trial]').waitFor();
  return opened;
}

async function close({page, said}) {
  await page.context().close();
  assert.deepStrictEqual(said, []);
}

const seconds = async (page) => parseFloat(await page.getByTestId('replay-time').textContent());
const pressed = (page, robot) => page.getByTestId(`replay-robot-${robot}`).getAttribute('aria-pressed');

const tests = {};

tests['keys move the time and pick robots'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  await page.getByTestId('replay-stage').focus();
  for (const key of ['ArrowRight', 'ArrowRight', 'Shift+ArrowRight', 'ArrowLeft']) await page.keyboard.press(key);
  assert.strictEqual(await seconds(page), 1.1);
  await page.keyboard.press('2');
  assert.strictEqual(await pressed(page, 2), 'true');
  await page.keyboard.press('Escape');
  assert.strictEqual(await pressed(page, 2), 'false');
  await page.keyboard.press('End');
  const end = await seconds(page);
  assert.ok(end > 5);
  await page.keyboard.press('Home');
  assert.strictEqual(await seconds(page), 0);
  await page.getByTestId('replay-speed').selectOption('16');
  await page.getByTestId('replay-stage').focus();
  await page.keyboard.press('Space');
  await page.waitForFunction(() => parseFloat(document.querySelector('[data-testid=replay-time]').textContent) > 1);
  await page.keyboard.press('Space');
  const stopped = await seconds(page);
  await page.waitForTimeout(200);
  assert.strictEqual(await seconds(page), stopped);
  await close(opened);
};

tests['a robot is picked on the map, an event is jumped to'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  const map = page.getByTestId('replay-map');
  // by pointing at every place of a grid until something is hit
  const box = await map.boundingBox();
  let hit = false;
  for (let y = 10; y < box.height && !hit; y += 12)
    for (let x = 10; x < box.width && !hit; x += 12) {
      hit = await map.evaluate(
        (canvas, at) => {
          const where = canvas.getBoundingClientRect();
          const send = (type) =>
            canvas.dispatchEvent(
              new PointerEvent(type, {
                pointerId: 1,
                clientX: where.left + at.x,
                clientY: where.top + at.y,
                bubbles: true,
              })
            );
          canvas.setPointerCapture = () => {};
          send('pointerdown');
          send('pointerup');
          return document.querySelector('.replay-robot[aria-pressed="true"]') !== null;
        },
        {x, y}
      );
    }
  assert.ok(hit, 'no robot can be picked on the map');
  const last = page.getByTestId('replay-events').locator('button').last();
  const from = parseFloat(await last.textContent());
  await last.click();
  assert.strictEqual(await seconds(page), from);
  assert.match(await last.getAttribute('class'), /now/);
  await close(opened);
};

tests['another trial starts at time zero'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  const ids = await page.evaluate(() => dmrp.data.replays.map((replay) => replay.trial));
  assert.ok(ids.length > 1, 'the quickstart has one replay only');
  await page.getByTestId('replay-scrub').fill('5');
  await page.getByTestId('replay-trial').selectOption(String(ids[1]));
  await page.locator(`#replay[data-trial="${ids[1]}"]`).waitFor();
  assert.strictEqual(await seconds(page), 0);
  assert.strictEqual(await page.evaluate(() => dmrp.open_replay(123456)), false);
  await close(opened);
};

tests['the time and the picture agree with the trace'] = async (browser) => {
  const opened = await open_replay(browser);
  const found = await opened.page.evaluate(() => {
    const entry = dmrp.data.replays[0];
    const row = dmrp.data.trials.id.indexOf(entry.trial);
    return {
      packed: document.getElementById(entry.element).textContent,
      sim_time_s: dmrp.data.trials.sim_time_s[row],
      success: dmrp.data.values.success[row],
    };
  });
  const replay = await recording.load({textContent: found.packed});
  const arrived = replay.robots.filter((robot) => robot.arrival !== null).length;
  assert.ok(
    Math.abs(replay.end - found.sim_time_s) < 0.021,
    `${replay.end} s, but the trial took ${found.sim_time_s} s`
  );
  assert.strictEqual(arrived / replay.robots.length, found.success);
  await close(opened);
};

tests['without WebGL the flat map stays, with a message'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  await page.evaluate(() => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return /webgl/.test(kind) ? null : get.call(this, kind, ...rest);
    };
  });
  await page.getByTestId('replay-3d').click();
  assert.match(await page.locator('.replay-message').textContent(), /no WebGL/);
  assert.strictEqual(await page.getByTestId('replay-stage').getAttribute('data-mode'), '2d');
  await close(opened);
};

tests['three.js is unpacked when the 3-D view opens, and once'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  const mode = () => page.getByTestId('replay-stage').getAttribute('data-mode');
  assert.strictEqual(await page.evaluate(() => typeof window.THREE), 'undefined');
  await page.getByTestId('replay-3d').click();
  await page.locator('[data-testid=replay-stage][data-mode="3d"]').waitFor();
  assert.strictEqual(await page.evaluate(() => typeof window.THREE), 'object');
  await page.getByTestId('replay-2d').click();
  assert.strictEqual(await mode(), '2d');
  await page.evaluate(() => document.getElementById('dmrp-three').remove());
  await page.getByTestId('replay-3d').click();
  await page.locator('[data-testid=replay-stage][data-mode="3d"]').waitFor();
  assert.strictEqual(await page.locator('canvas.solid').count(), 1);
  await close(opened);
};

tests['a click on 2-D while three.js is unpacked keeps the flat map'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  await page.evaluate(() => {
    for (const mode of ['3d', '3d', '2d']) document.querySelector(`[data-testid=replay-${mode}]`).click();
  });
  await page.waitForFunction(() => window.THREE);
  await page.waitForTimeout(300);
  assert.strictEqual(await page.getByTestId('replay-stage').getAttribute('data-mode'), '2d');
  assert.ok((await page.locator('canvas.solid').count()) <= 1);
  await close(opened);
};

tests['a damaged three.js is reported, the flat map stays'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  await page.evaluate(() => {
    document.getElementById('dmrp-three').textContent = 'AAAA';
  });
  await page.getByTestId('replay-3d').click();
  await page.locator('.replay-message:not([hidden])').waitFor();
  assert.match(await page.locator('.replay-message').textContent(), /cannot be unpacked/);
  assert.strictEqual(await page.getByTestId('replay-stage').getAttribute('data-mode'), '2d');
  await close(opened);
};

tests['a damaged replay is reported, the others play'] = async (browser) => {
  const opened = await open_replay(browser);
  const {page} = opened;
  await page.evaluate(() => {
    document.getElementById(dmrp.data.replays[1].element).textContent = 'AAAA';
  });
  assert.strictEqual(await page.evaluate(() => dmrp.open_replay(dmrp.data.replays[1].trial)), false);
  assert.match(await page.locator('.replay-message').textContent(), /cannot be unpacked/);
  assert.strictEqual(await page.evaluate(() => dmrp.open_replay(dmrp.data.replays[0].trial)), true);
  assert.ok(await page.locator('.replay-message').isHidden());
  await close(opened);
};

run_tests(tests);
