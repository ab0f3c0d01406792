// SPDX-License-Identifier: MIT
// The report's page in a browser: report_page.cjs SOURCE_FOLDER. Reports of the quickstart and of a small experiment
// with several combinations, opened from a file.
'use strict';
const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const {
  LAPTOP,
  PHONE,
  browser_or_skip,
  run_experiment,
  scratch_folder,
  with_data,
  open_report,
  shared_report,
  close,
  check_layout,
  images_of,
  pages_of,
  painted_colour,
  read_csv,
  run_tests,
} = require('./report_browser.cjs');

browser_or_skip();
const source = process.argv[2];
const scratch = scratch_folder();
const quickstart = run_experiment(path.join(source, 'examples/quickstart.toml'), path.join(scratch, 'quickstart'));
const run_crossing = (name, ...options) =>
  run_experiment(path.join(source, 'tests/end_to_end/crossing.toml'), path.join(scratch, name), {
    env: {DMRP_SCENARIO_PATH: path.join(source, 'tests/end_to_end/worlds')},
    options,
  });
const crossing = run_crossing('crossing');
// each trial on a task of its own
const run_tasks = (name, ...options) => {
  const experiment = path.join(scratch, `${name}.toml`);
  const crossing = fs.readFileSync(path.join(source, 'tests/end_to_end/crossing.toml'), 'utf8');
  fs.writeFileSync(experiment, crossing.replace('use = "crossing"', '$&\nstart_jitter = { position_m = 0.02 }'));
  return run_experiment(experiment, path.join(scratch, name), {
    env: {DMRP_SCENARIO_PATH: path.join(source, 'tests/end_to_end/worlds')},
    options,
  });
};
const six_pairs = run_tasks('six_pairs', '--trials', '6');
const two_pairs = run_tasks('two_pairs', '--trials', '2');

const SECTIONS = ['results', 'every trial', 'all metrics', 'provenance'];

// The numbers of a table's column in the order of its rows, dashes as null.
function column(page, table, index) {
  return page.locator(`${table} tbody tr:not(.group)`).evaluateAll(
    (rows, i) =>
      rows.map((row) => {
        const mean = row.querySelectorAll('td')[i].querySelector('.mean');
        const text = [...mean.childNodes].find((node) => node.nodeType === Node.TEXT_NODE).textContent;
        return text === '—' ? null : Number(text.replace('\u2212', '-'));
      }),
    index
  );
}

function is_sorted(numbers, descending) {
  const defined = numbers.filter((number) => number !== null);
  return (
    defined.every((number, i) => i === 0 || (descending ? defined[i - 1] >= number : defined[i - 1] <= number)) &&
    numbers.slice(defined.length).every((number) => number === null)
  );
}

const tests = {};

for (const [name, report] of Object.entries({quickstart, crossing})) {
  for (const [width, viewport] of Object.entries({laptop: LAPTOP, phone: PHONE})) {
    for (const colorScheme of ['light', 'dark']) {
      tests[`${name} on a ${width}, ${colorScheme}`] = async (browser) => {
        const opened = await shared_report(browser, report, {viewport, colorScheme});
        const {page} = opened;
        await check_layout(page, `${name} on a ${width}`);
        const titles = (await page.locator('#contents a').allTextContents()).map((title) => title.toLowerCase());
        for (const section of SECTIONS) assert.ok(titles.includes(section), `no section '${section}' but ${titles}`);
        assert.strictEqual(await page.locator('h1').textContent(), name);
        await close(opened);
      };
    }
  }
}

tests['the tables show the numbers of summary.csv'] = async (browser) => {
  for (const report of [quickstart, crossing]) {
    const opened = await shared_report(browser, report);
    const lines = read_csv(path.join(path.dirname(report), 'summary.csv'));
    const layout = await opened.page.evaluate(() => dmrp.data.layouts.report.tables.find((table) => !table.across));
    const names = await opened.page.locator(`#table-${layout.id} tbody tr:not(.group) th`).allTextContents();
    assert.ok(names.length > 0);
    for (const [index, {metric, decimals}] of layout.columns.entries()) {
      const shown = await column(opened.page, `#table-${layout.id}`, index);
      names.forEach((name, row) => {
        const line = lines.find(
          (one) => one.metric === metric && `${one.global_planner} + ${one.local_controller}` === name
        );
        assert.ok(line, `summary.csv has no ${metric} of ${name}`);
        const expected = line.mean === '' ? null : Number(Number(line.mean).toFixed(decimals));
        assert.strictEqual(shown[row], expected, `${metric} of ${name}`);
      });
    }
    await close(opened);
  }
};

tests['all metrics of a combination are those of summary.csv'] = async (browser) => {
  const opened = await shared_report(browser, quickstart);
  const lines = read_csv(path.join(path.dirname(quickstart), 'summary.csv'));
  const rows = await opened.page
    .locator('#metrics tbody tr')
    .evaluateAll((all) =>
      all.map((row) => [
        row.querySelector('.name').textContent,
        row.querySelector('.mean').textContent.replace('\u2212', '-'),
      ])
    );
  assert.ok(rows.length > 20);
  for (const [metric, mean] of rows) {
    const line = lines.find((one) => one.metric === metric);
    assert.ok(line, `summary.csv has no ${metric}`);
    if (line.mean === '') assert.strictEqual(mean, '—', metric);
    else
      assert.ok(
        Math.abs(Number(mean) - Number(line.mean)) <= 0.006 * Math.max(1e-4, Math.abs(line.mean)) + 0.5e-6 ||
          mean === Number(line.mean).toFixed((mean.split('.')[1] || '').length),
        `${metric}: ${mean}, not ${line.mean}`
      );
  }
  await opened.page.getByPlaceholder('Search metrics').fill('planning time');
  const found = await opened.page.locator('#metrics tbody .name').allTextContents();
  assert.ok(found.includes('planning_time') && found.length < rows.length / 2, `found ${found}`);
  await close(opened);
};

tests['a header sorts its table, by pointer and by key'] = async (browser) => {
  const opened = await shared_report(browser, crossing);
  const {page} = opened;
  const layout = await page.evaluate(() => dmrp.data.layouts.report.tables.find((table) => !table.across));
  const table = `#table-${layout.id}`;
  for (const [index] of layout.columns.entries()) {
    const header = page.locator(`${table} thead th.number`).nth(index);
    assert.strictEqual(await header.getAttribute('aria-sort'), 'none');
    await header.locator('button').click();
    const first = await header.getAttribute('aria-sort');
    assert.ok(is_sorted(await column(page, table, index), first === 'descending'), `column ${index}, ${first}`);
    await header.locator('button').press('Enter');
    const second = await header.getAttribute('aria-sort');
    assert.notStrictEqual(second, first);
    assert.ok(is_sorted(await column(page, table, index), second === 'descending'), `column ${index}, ${second}`);
    assert.strictEqual(await page.locator(`${table} thead th[aria-sort$="scending"]`).count(), 1);
  }
  const before = await page.locator(`${table} tbody th[scope=row]`).allTextContents();
  await page.locator(`${table} thead .names button`).nth(1).click();
  const after = await page.locator(`${table} tbody th[scope=row]`).allTextContents();
  assert.deepStrictEqual([...after].sort(), [...before].sort());
  const controllers = after.map((name) => name.split(' + ')[1]);
  assert.deepStrictEqual(controllers, [...controllers].sort());
  await close(opened);
};

tests['intervals and the paper\u2019s rule are shown on request'] = async (browser) => {
  const opened = await shared_report(browser, crossing);
  const interval = opened.page.locator('.tables .interval:not(:empty)').first();
  const paper = opened.page.locator('.tables .paper').first();
  assert.deepStrictEqual([await interval.isVisible(), await paper.isVisible()], [true, false]);
  await opened.page.getByLabel('95 % intervals').uncheck();
  await opened.page.getByLabel('the paper\u2019s rule').check();
  assert.deepStrictEqual([await interval.isVisible(), await paper.isVisible()], [false, true]);
  await close(opened);
};

tests['a button switches between light and dark'] = async (browser) => {
  const opened = await shared_report(browser, quickstart);
  const background = () => opened.page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await background();
  await opened.page.locator('#theme').click();
  assert.notStrictEqual(await background(), light);
  await opened.page.locator('#theme').click();
  assert.strictEqual(await background(), light);
  await close(opened);
};

tests['the heat map and the points show the selected metric'] = async (browser) => {
  const opened = await shared_report(browser, crossing);
  const {page} = opened;
  for (const section of ['#heat-map', '#distributions']) {
    await page.locator(`${section} select`).first().selectOption('path_length');
    assert.match(await page.locator(section).textContent(), /path length \(m\)/);
    await check_layout(page, section);
  }
  assert.strictEqual(await page.locator('#heat-map .cell').count(), 4);
  assert.strictEqual(await page.locator('#distributions svg .mark.clickable').count(), 12);
  await close(opened);
};

tests['a cell of the heat map without a value looks like none'] = async (browser) => {
  const report = with_data(crossing, (data) => {
    // a high and a low value, one that is undefined, one that was not run
    const metric = data.metrics.findIndex(({name}) => name === 'success');
    [1, 0, null].forEach((mean, i) => Object.assign(data.summaries[i][metric], {mean, low: mean, high: mean}));
    data.layouts.report.heat_map = {metric: 'success'};
    data.best = data.best.filter((mark) => mark.metric !== 'success');
    const last = data.combinations.pop();
    data.combinations.push({...last, global_planner: 'another'});
  });
  const opened = await open_report(browser, report);
  const {page} = opened;
  const colour = (cell) => painted_colour(page, page.locator(cell).first());
  for (const theme of ['light', 'dark']) {
    const ground = await colour('#heat-map thead td');
    const distance = (from) => Math.hypot(...ground.map((value, i) => value - from[i]));
    const best = distance(await colour('#heat-map .cell:has-text("1.00")'));
    const cells = await page.locator('#heat-map .cell.nothing').all();
    assert.strictEqual(cells.length, 3);
    for (const cell of cells) {
      const empty = distance(await painted_colour(page, cell));
      assert.ok(empty < best / 4, `${theme}: without a value ${empty} from the ground, the best ${best}`);
    }
    await page.locator('#theme').click();
  }
  await close(opened);
};

tests['few tasks have no p and no correlation'] = async (browser) => {
  const opened = await open_report(browser, two_pairs);
  const {page} = opened;
  for (const text of await page.locator('#diagnosis .figure-line').allTextContents()) assert.match(text, /ρ: too few \([0-5]\)/);
  for (const text of await page.locator('#diagnosis tbody td').allTextContents()) assert.match(text, /^too few \([0-5]\)$/);
  assert.strictEqual(await page.locator('#comparisons').count(), 0);
  assert.match(await page.locator('#left-out').textContent(), /Paired differences: no two combinations share 5 tasks/);
  await close(opened);
  const one_pair = with_data(six_pairs, (data) => {
    for (const one of data.comparisons.filter((_, i) => i % 2 === 0)) Object.assign(one, {n: 1, effect: -1, p: null, p_holm: null});
  });
  const mixed = await open_report(browser, one_pair);
  const rows = await mixed.page.locator('#comparisons tbody tr:not(.group)').allTextContents();
  const [few_rows, others] = [true, false].map((wanted) => rows.filter((row) => /——\u22121\.001/.test(row) === wanted));
  assert.ok(few_rows.length > 0 && others.length > 0, rows.join('\n'));
  await close(mixed);
};

tests['points are selected by keys and describe their trial'] = async (browser) => {
  const opened = await shared_report(browser, crossing);
  const {page} = opened;
  await page.locator('#distributions .plot svg').first().focus();
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowDown');
  assert.match(await page.locator('#tip').textContent(), /trial \d+ · crossing/);
  assert.strictEqual(await page.locator('#distributions .chosen').count(), 1);
  await page.keyboard.press('Enter');
  assert.match(await page.locator('#distributions .detail').textContent(), /seed \d+/);
  await close(opened);
};

tests['a name links to all metrics of its combination'] = async (browser) => {
  const opened = await shared_report(browser, crossing);
  const link = opened.page.locator('.results tbody th a').nth(2);
  const name = await link.textContent();
  await link.click();
  assert.match(await opened.page.locator('#title-metrics').textContent(), new RegExp(`${name.replace('+', '\\+')}$`));
  await close(opened);
};

// The crossing's report with its combinations repeated in six scenarios, four columns of planned values in each.
function of_six_scenarios(report) {
  return with_data(report, (data) => {
    const per_scenario = (rows) =>
      Array.from({length: 6}, (_, i) => rows.map((row) => ({...row, scenario: `crossing ${i}`}))).flat();
    const count = data.combinations.length;
    data.scenarios = Array.from({length: 6}, (_, i) => ({...data.scenarios[0], name: `crossing ${i}`}));
    data.combinations = per_scenario(data.combinations);
    data.planners = per_scenario(data.planners);
    data.summaries = data.combinations.map((_, i) => data.summaries[i % count]);
    data.planner_summaries = data.planners.map((_, i) => data.planner_summaries[i % data.planner_summaries.length]);
  });
}

tests['six scenarios fit, and each can be chosen'] = async (browser) => {
  const report = of_six_scenarios(crossing);
  const opened = await open_report(browser, report);
  const {page} = opened;
  await check_layout(page, 'six scenarios');
  await page.locator('#tables').getByLabel('Scenario').selectOption('all');
  for (const viewport of [LAPTOP, PHONE]) {
    await page.setViewportSize(viewport);
    await check_layout(page, 'all of six scenarios');
  }
  assert.match(await page.locator('#table-plans').textContent(), /crossing 5/);
  await close(opened);
};

tests['the last column of a wide table is reached by a tap, beside the first'] = async (browser) => {
  const opened = await shared_report(browser, crossing, {viewport: PHONE});
  const {page} = opened;
  const frame = page.locator('.table-frame', {has: page.locator('#table-driving')});
  const last = frame.locator('thead th').last();
  for (let taps = 0; taps < 12 && (await frame.locator('.more-columns').isVisible()); ++taps) {
    await frame.locator('.more-columns').tap();
    await page.waitForTimeout(50);
  }
  const [box, cell, first] = [
    await frame.boundingBox(),
    await last.boundingBox(),
    await frame.locator('tbody th').first().boundingBox(),
  ];
  assert.ok(cell.x + cell.width <= box.x + box.width + 2, 'the last column is cut');
  assert.ok(Math.abs(first.x - box.x) < 2 && first.x + first.width <= cell.x + 1, 'the first column is gone');
  await close(opened);
};

tests['an abbreviation is explained on tap'] = async (browser) => {
  const opened = await shared_report(browser, crossing, {viewport: PHONE});
  const {page} = opened;
  const about = await page.evaluate(() => dmrp.data.metrics.find((metric) => metric.name === 'pfd').description);
  const tip = page.locator('#tip');
  assert.ok(await tip.isHidden());
  const header = page.locator('#table-driving thead button', {hasText: 'PFD'});
  await header.scrollIntoViewIfNeeded();
  await header.tap();
  await tip.waitFor({state: 'visible'});
  assert.ok((await tip.textContent()).includes(about), await tip.textContent());
  const box = await tip.boundingBox();
  assert.ok(box.x >= 0 && box.x + box.width <= PHONE.width, 'the explanation leaves the window');
  await page.locator('#tables h2').tap();
  assert.ok(await tip.isHidden());
  await close(opened);
};

tests['the contents stay, and a jump arrives, while sections are filled'] = async (browser) => {
  const context = await browser.newContext({viewport: LAPTOP});
  const page = await context.newPage();
  await page.goto(`file://${enlarged(crossing)}`, {waitUntil: 'domcontentloaded'});
  const contents = () => page.locator('#contents a').allTextContents();
  const at_first = await contents();
  await page.evaluate(() => document.querySelector('#contents a[href="#metrics"]').click());
  await page.locator('#provenance.ready').waitFor({state: 'attached'});
  await page.waitForTimeout(300);
  assert.deepStrictEqual(await contents(), at_first);
  const top = await page.evaluate(
    () =>
      document.querySelector('#metrics h2').getBoundingClientRect().top -
      document.getElementById('contents').getBoundingClientRect().bottom
  );
  assert.ok(top >= 0 && top < 60, `the title is ${top} px below the contents`);
  assert.strictEqual(await page.locator('#contents a[aria-current]').textContent(), 'All metrics');
  await context.close();
};

tests['every figure is saved as SVG, in light colours and without a style sheet'] = async (browser) => {
  const opened = await open_report(browser, six_pairs, {colorScheme: 'dark'});
  const {page} = opened;
  for (const section of ['heat-map', 'distributions', 'diagnosis', 'comparisons', 'curves', 'completion']) {
    const button = page.locator(`#${section} .figure-tools button`).first();
    const [saved] = await Promise.all([page.waitForEvent('download'), button.click()]);
    assert.match(saved.suggestedFilename(), new RegExp(`^${section}.*\\.svg$`));
    const text = fs.readFileSync(await saved.path(), 'utf8');
    const found = await page.evaluate((svg) => {
      const root = new DOMParser().parseFromString(svg, 'image/svg+xml').documentElement;
      return {
        name: root.nodeName,
        texts: [...root.querySelectorAll('text')].map((one) => one.textContent).join(' '),
        marks: root.querySelectorAll('path, line, circle, rect').length,
      };
    }, text);
    assert.strictEqual(found.name, 'svg');
    assert.ok(found.marks > 3, `${section}: ${found.marks} marks`);
    assert.match(found.texts, /[a-z0-9]{2}/, section);
    assert.doesNotMatch(text, /class=|var\(/, section);
  }
  assert.strictEqual(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await close(opened);
};

tests['the printed report is complete'] = async (browser) => {
  const opened = await open_report(browser, crossing, {colorScheme: 'dark'});
  const pdf = await opened.page.pdf({format: 'A4'});
  assert.ok(pdf.length > 20000, `a PDF of ${pdf.length} bytes`);
  await opened.page.emulateMedia({media: 'print'});
  assert.ok(await opened.page.locator('#replay canvas').first().isVisible());
  assert.strictEqual(await opened.page.locator('#metrics table').isVisible(), false);
  assert.match(await opened.page.locator('#metrics').innerText(), /summary\.csv/);
  // some lines of no use on paper, alone on the last page
  assert.strictEqual(await opened.page.locator('#left-out').isVisible(), false);
  await close(opened);
};

// As `chromium --print-to-pdf` does.
tests['a report that is printed once it is loaded shows the replay, undistorted'] = async (browser) => {
  for (const report of [quickstart, crossing]) {
    const context = await browser.newContext({viewport: {width: 800, height: 600}});
    const page = await context.newPage();
    await page.goto(`file://${report}`);
    const pdf = await page.pdf({format: 'A4'});
    const drawn = images_of(pdf).filter((image) => image.height > 100 && image.colours > 5);
    assert.strictEqual(drawn.length, 1, JSON.stringify(images_of(pdf)));
    assert.ok(drawn[0].width > 600 && drawn[0].width <= 690, `${drawn[0].width} px wide`);
    assert.ok(pages_of(pdf) < 12, `${pages_of(pdf)} pages`);
    await context.close();
  }
};

tests['the replay plays, seeks and switches to 3-D'] = async (browser) => {
  const opened = await shared_report(browser, quickstart);
  const {page} = opened;
  assert.ok((await page.evaluate(() => dmrp.data.replays.length)) > 0, 'the quickstart has no replay');
  const id = await page.evaluate(() => dmrp.data.replays[0].trial);
  await page.evaluate((trial) => dmrp.open_replay(trial), id);
  const section = page.locator(`#replay[data-trial="${id}"]`);
  await section.waitFor();
  const time = () => page.getByTestId('replay-time').textContent();
  const start = await time();
  await page.getByTestId('replay-scrub').fill('12.5');
  assert.notStrictEqual(await time(), start);
  assert.match(await time(), /12\.5/);
  const pixels = (testid) => page.locator(`[data-testid="${testid}"]`).evaluate((canvas) => canvas.toDataURL().length);
  assert.ok((await pixels('replay-map')) > 3000, 'the map is empty');
  await page.getByTestId('replay-play').click();
  await page.waitForFunction(
    (before) => document.querySelector('[data-testid="replay-time"]').textContent !== before,
    await time()
  );
  await page.getByTestId('replay-play').click();
  await page.getByTestId('replay-3d').click();
  await page.getByTestId('replay-scrub').fill('20');
  assert.match(await time(), /20\.0/);
  await page.getByTestId('replay-2d').click();
  await close(opened);
};

// The crossing's report with 48 combinations of 20 trials.
function enlarged(report) {
  return with_data(report, (data) => {
    const fields = {p: 'global_planner', c: 'local_controller'};
    const first = data.combinations[0];
    const from = data.trials.id.length;
    data.combinations = Array.from({length: 48}, (_, i) => ({
      ...first,
      [fields.p]: `p${Math.floor(i / 8)}`,
      [fields.c]: `c${i % 8}`,
    }));
    data.summaries = data.combinations.map((_, i) => data.summaries[i % data.summaries.length]);
    for (const [name, column] of Object.entries(data.trials)) {
      data.trials[name] = Array.from(
        {length: 960},
        (_, i) => ({id: i, combination: Math.floor(i / 20), repetition: i % 20}[name] ?? column[i % from])
      );
    }
    for (const [name, column] of Object.entries(data.values))
      data.values[name] = Array.from(
        {length: 960},
        (_, i) => column[i % from] && column[i % from] * (1 + (i % 97) / 300)
      );
    data.run.trials_planned = 960;
    data.completion = [];
    data.curves = [];
    data.pedestrian_delay = [];
  });
}

tests['960 trials are shown'] = async (browser) => {
  const report = enlarged(crossing);
  assert.ok(fs.statSync(report).size < 25e6);
  const opened = await open_report(browser, report);
  const {page} = opened;
  const layout = await page.evaluate(() => dmrp.data.layouts.report.tables.find((table) => !table.across));
  await page.locator(`#table-${layout.id} thead th.number button`).first().click();
  assert.ok(is_sorted(await column(page, `#table-${layout.id}`, 0), true));
  await check_layout(page, '960 trials');
  assert.strictEqual(await opened.page.locator('#distributions svg .mark.clickable').count(), 960);
  await close(opened);
};

tests['the file requests no other file'] = async () => {
  for (const report of [quickstart, crossing]) {
    const text = fs.readFileSync(report, 'utf8');
    assert.doesNotMatch(
      text,
      /<(script|img|iframe|source)[^>]*\ssrc=|<link[^>]*\shref="(?!data:)|@import|url\(\s*["']?(https?:)?\/\//i
    );
  }
};

run_tests(tests);
