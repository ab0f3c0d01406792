// SPDX-License-Identifier: MIT
// The replay in a browser: replay_player.cjs PROJECT.
'use strict';
const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const {
  LAPTOP,
  PHONE,
  run_experiment,
  scratch_folder,
  open_report,
  shared_report,
  close,
  with_replay,
  run_tests,
} = require('./report_browser.cjs');

// 3-D is rendered by software here: half of a laptop's pixels take half of the time.
const SMALL = {width: 900, height: 600};

const {page_modules} = require('./page_modules.cjs');

const project = process.argv[2];
const {recording} = page_modules(path.join(project, 'host/report/page'), {recording: 'replay/recording.js'});
const report = run_experiment(path.join(project, 'examples/quickstart.toml'), path.join(scratch_folder(), 'run'));

async function begin(opened) {
  const trial = await opened.page.evaluate(() => dmrp.data.replays[0].trial);
  await opened.page.evaluate((id) => dmrp.open_replay(id), trial);
  await opened.page.locator(`#replay[data-trial="${trial}"]`).waitFor();
  return opened;
}

const open_replay = async (browser, options = {}) => begin(await open_report(browser, options.report || report, options));
const shared_replay = async (browser, options = {}) => begin(await shared_report(browser, report, options));

const seconds = async (page) => parseFloat(await page.getByTestId('replay-time').textContent());
const pressed = (page, robot) => page.getByTestId(`replay-robot-${robot}`).getAttribute('aria-pressed');

const tests = {};

tests['keys move the time and pick robots'] = async (browser) => {
  const opened = await shared_replay(browser);
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

tests['map, time line and controls are in the window together'] = async (browser) => {
  for (const viewport of [LAPTOP, PHONE]) {
    const opened = await shared_replay(browser, {viewport});
    const {page} = opened;
    await page.waitForTimeout(300);
    const below = (await page.locator('#contents').boundingBox()).height;
    for (const part of ['.replay-stage', '.replay-time-line', '.replay-controls']) {
      const box = await page.locator(part).boundingBox();
      assert.ok(box.y >= below, `${part} begins at ${box.y} px, below ${below}`);
      const end = box.y + box.height;
      assert.ok(end <= viewport.height, `${part} ends at ${end} of ${viewport.height} px`);
    }
    await close(opened);
  }
};

tests['the whole world is shown at first'] = async (browser) => {
  const opened = await shared_replay(browser);
  const {page} = opened;
  // the share of pixels that differ from the first picture
  const differs = () =>
    page.getByTestId('replay-map').evaluate((canvas) => {
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', {willReadFrequently: true});
      copy.drawImage(canvas, 0, 0);
      const seen = new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
      window.first_seen = window.first_seen || seen;
      return seen.filter((pixel, i) => pixel !== window.first_seen[i]).length / seen.length;
    });
  await differs();
  await page.getByTestId('replay-robots').click();
  assert.ok((await differs()) > 0.05);
  await page.getByTestId('replay-fit').click();
  assert.ok((await differs()) < 0.001);
  await close(opened);
};

tests['the player fills the screen and leaves it'] = async (browser) => {
  const opened = await shared_replay(browser);
  const {page} = opened;
  const height = async () => (await page.getByTestId('replay-stage').boundingBox()).height;
  const before = await height();
  await page.getByTestId('replay-fill').click();
  await page.waitForFunction(
    (least) => document.querySelector('.replay-stage').clientHeight > least,
    before + 50
  );
  assert.ok((await page.locator('.replay-controls').boundingBox()).y < LAPTOP.height);
  await page.getByTestId('replay-fill').click();
  await page.waitForFunction((was) => document.querySelector('.replay-stage').clientHeight === was, before);
  await close(opened);
};

// The quickstart's replay with each robot six times.
function of_24_robots() {
  return with_replay(report, 'dmrp-replay-0', (replay) => {
    const robots = replay.robots;
    replay.robots = Array.from({length: 24}, (_, i) => ({...robots[i % 4], name: `robot ${i}`}));
    for (const plan of replay.plans) plan.paths = Array.from({length: 24}, (_, i) => plan.paths[i % 4]);
  });
}

tests['24 robots have their own colours and numbers, and are marked by the pointer'] = async (browser) => {
  const opened = await open_replay(browser, {report: of_24_robots()});
  const {page} = opened;
  const badges = page.locator('.replay-number');
  const colours = await badges.evaluateAll((all) => all.map((one) => getComputedStyle(one).borderTopColor));
  assert.strictEqual(new Set(colours).size, 24);
  const numbers = await badges.allTextContents();
  const names = await page.locator('.replay-robot-name').allTextContents();
  assert.deepStrictEqual(names, numbers.map((number) => `robot ${number}`));
  await page.getByTestId('replay-robot-17').hover();
  assert.deepStrictEqual(
    await page.locator('.replay-lines path.marked').evaluateAll((all) => all.map((one) => one.dataset.robot)),
    ['17', '17']
  );
  assert.match(await page.locator('.replay-curves').textContent(), /robot 17: \d/);
  await page.locator('.replay-summary').hover();
  assert.strictEqual(await page.locator('.replay-lines path.marked').count(), 0);
  // on a curve
  const line = page.locator('.replay-lines path[data-robot="2"]').first();
  const at = await line.evaluate((line) => {
    const point = line.getPointAtLength(line.getTotalLength() / 2);
    const box = line.ownerSVGElement.getBoundingClientRect();
    return [box.left + point.x, box.top + point.y];
  });
  await page.mouse.move(...at);
  assert.strictEqual(await page.locator('.replay-lines path.marked').count(), 2);
  await close(opened);
};

// The quickstart's replay with a transporter and a car in place of two discs.
function of_three_kinds() {
  return with_replay(report, 'dmrp-replay-0', (replay) => {
    const outline = [-400, -250, 400, -250, 400, 250, -400, 250];
    Object.assign(replay.robots[0], {parts: [outline], drive: 'ackermann', wheelbase: 500});
    Object.assign(replay.robots[1], {parts: [outline], drive: 'holonomic'});
  });
}

tests['the 3-D view shows kinds of robots and walking people, from three cameras'] = async (browser) => {
  const pictures = {};
  for (const [name, open] of Object.entries({
    discs: () => shared_replay(browser, {viewport: SMALL}),
    kinds: () => open_replay(browser, {report: of_three_kinds(), viewport: SMALL}),
  })) {
    const opened = await open();
    const {page} = opened;
    // 3-D pictures are kept to the end of the task that drew them
    const picture = (click) =>
      page.evaluate((id) => {
        document.querySelector(`[data-testid=${id}]`).click();
        return document.querySelector('canvas.solid').toDataURL();
      }, click);
    await page.getByTestId('replay-3d').click();
    await page.locator('[data-testid=replay-stage][data-mode="3d"]').waitFor();
    for (const camera of ['overview', 'low', 'follow'])
      pictures[`${name}, ${camera}`] = await picture(`replay-camera-${camera}`);
    assert.ok(await page.getByTestId('replay-follow').isChecked());
    assert.strictEqual(await pressed(page, 0), 'true');
    const people = page.getByTestId('replay-people');
    const with_people = await picture('replay-camera-low');
    await people.uncheck();
    assert.notStrictEqual(await picture('replay-camera-low'), with_people);
    assert.ok(!(await page.getByTestId('replay-follow').isChecked()));
    await close(opened);
  }
  assert.strictEqual(new Set(Object.values(pictures)).size, 6);
};

tests['picture, curves and video are saved, flat and in 3-D'] = async (browser) => {
  const opened = await shared_replay(browser, {viewport: SMALL});
  const {page} = opened;
  const bytes = async (saved) => fs.readFileSync(await saved.path());
  const download = async (click) => (await Promise.all([page.waitForEvent('download'), click()]))[0];
  const press = (what) => page.getByTestId(`replay-save-${what}`).click();
  await page.getByTestId('replay-scrub').fill('5');
  for (const mode of ['2d', '3d']) {
    await page.getByTestId(`replay-${mode}`).click();
    await page.locator(`[data-testid=replay-stage][data-mode="${mode}"]`).waitFor();
    const picture = await bytes(await download(() => press('picture')));
    assert.strictEqual(picture.subarray(1, 4).toString(), 'PNG');
    assert.ok(picture.length > 5000, `a picture of ${picture.length} bytes`);
    await press('video');
    await page.waitForFunction(() => parseFloat(document.querySelector('[data-testid=replay-time]').textContent) > 0.3);
    const video = await download(() => press('video'));
    assert.match(video.suggestedFilename(), /^trial_\d+\.webm$/);
    assert.strictEqual((await bytes(video)).subarray(0, 4).toString('hex'), '1a45dfa3');
    assert.strictEqual(await page.getByTestId('replay-save-video').textContent(), 'video');
  }
  const curves = await download(() => press('curves'));
  assert.match((await bytes(curves)).toString(), /Speed \(m\/s\)/);
  await close(opened);
};

tests['a robot is picked on the map, an event is jumped to'] = async (browser) => {
  const opened = await shared_replay(browser);
  const {page} = opened;
  // where robot 1 starts, in the whole world with its margin of 10 px
  const replay = await recording.load({
    textContent: await page.evaluate(() => document.getElementById(dmrp.data.replays[0].element).textContent),
  });
  const box = await page.getByTestId('replay-map').boundingBox();
  const size = [0, 1].map((axis) => replay.upper[axis] - replay.lower[axis]);
  const scale = Math.min((box.width - 20) / size[0], (box.height - 20) / size[1]);
  await page.mouse.click(
    box.x + box.width / 2 + (replay.robots[1].x[0] - replay.lower[0] - size[0] / 2) * scale,
    box.y + box.height / 2 - (replay.robots[1].y[0] - replay.lower[1] - size[1] / 2) * scale
  );
  assert.strictEqual(await pressed(page, 1), 'true');
  const last = page.getByTestId('replay-events').locator('button').last();
  const from = parseFloat(await last.textContent());
  await last.click();
  assert.strictEqual(await seconds(page), from);
  assert.match(await last.getAttribute('class'), /now/);
  await close(opened);
};

tests['another trial starts at time zero'] = async (browser) => {
  const opened = await shared_replay(browser);
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
  const opened = await shared_replay(browser);
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
  const opened = await shared_replay(browser);
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
