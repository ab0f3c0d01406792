// SPDX-License-Identifier: MIT
// report_browser.cjs: helpers of the browser tests: run dmrp-host, open a report, record console messages, errors and
// network requests.
'use strict';
const assert = require('node:assert');
const {spawnSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const zlib = require('node:zlib');

const SKIPPED = 77;
const LAPTOP = {width: 1366, height: 768};
const PHONE = {width: 390, height: 844};

function find_browser() {
  const names = ['chromium', 'chromium-browser', 'google-chrome'];
  const folders = (process.env.PATH || '').split(':');
  return names.flatMap((name) => folders.map((folder) => path.join(folder, name))).find((file) => fs.existsSync(file));
}

// Returns {chromium, executable}, or ends the test as skipped.
function browser_or_skip() {
  const executable = find_browser();
  if (!executable) {
    console.log('skipped: there is no chromium on this machine');
    process.exit(SKIPPED);
  }
  return {chromium: require('playwright-core').chromium, executable};
}

// WebGL by software, for the 3-D view; flat pages are drawn without a GPU, which is faster.
async function launch() {
  const {chromium, executable} = browser_or_skip();
  return chromium.launch({
    executablePath: executable,
    args: [
      '--no-sandbox',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--use-gl=angle',
      '--use-angle=swiftshader-webgl',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
    ],
  });
}

// Runs an experiment into `folder`; returns the report's path.
function run_experiment(experiment, folder, {status = 0, options = [], env = {}} = {}) {
  const run = spawnSync(process.env.DMRP_HOST, [experiment, '--quiet', '--out', folder, ...options], {
    encoding: 'utf8',
    env: {...process.env, ...env},
  });
  assert.strictEqual(run.status, status, `dmrp-host ${experiment}: status ${run.status}\n${run.stderr}`);
  const report = path.join(folder, 'report.html');
  assert.ok(fs.existsSync(report), `${report} was not written\n${run.stderr}`);
  return report;
}

function scratch_folder() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'dmrp-report-'));
  process.on('exit', () => fs.rmSync(folder, {recursive: true, force: true}));
  return folder;
}

// Opens a report, or another page, and waits for its last section. `said` collects console messages, errors and requests: it must stay
// empty.
async function open_report(
  browser,
  report,
  {viewport = LAPTOP, colorScheme = 'light', last = '#provenance.ready'} = {}
) {
  const context = await browser.newContext({
    viewport,
    colorScheme,
    hasTouch: viewport.width < 600,
    isMobile: viewport.width < 600,
  });
  context.setDefaultTimeout(0); // CTest's time limit is that of a test: the machine may be busy
  const page = await context.newPage();
  const said = [];
  const url = `file://${report}`;
  page.on('console', (message) => {
    // from the software renderer, not from the page
    if (!/GL Driver Message|GPU stall|Automatic fallback to software WebGL/.test(message.text()))
      said.push(`console: ${message.text()}`);
  });
  page.on('pageerror', (error) => said.push(`error: ${error.stack}`));
  page.on('request', (request) => {
    if (request.url() !== url && !/^(data|blob):/.test(request.url())) said.push(`request: ${request.url()}`);
  });
  await page.goto(url);
  await page.locator(last).waitFor({state: 'attached'});
  return {page, said};
}

// The same for checks that leave the page as others can use it: these share one page of a report and a screen.
const shared = new Map();
async function shared_report(browser, report, {viewport = LAPTOP, colorScheme = 'light', ...more} = {}) {
  const key = `${report} ${viewport.width}`;
  if (!shared.has(key)) shared.set(key, {...(await open_report(browser, report, {viewport, ...more})), is_shared: true});
  const opened = shared.get(key);
  await opened.page.emulateMedia({colorScheme});
  await opened.page.waitForFunction((scheme) => document.documentElement.dataset.theme === scheme, colorScheme);
  return opened;
}

async function close({page, said, is_shared}) {
  assert.deepStrictEqual(said, []);
  if (!is_shared) await page.context().close();
}

// Checks that no plot or section is empty, the page fits the screen, a wide screen cuts no table and a small one says
// what it hides, and no text is NaN, null or an object.
async function check_layout(page, where) {
  const found = await page.evaluate(async () => {
    for (let frames = 0; frames < 2; ++frames) await new Promise(requestAnimationFrame); // sizes are observed in each
    const problems = [];
    const wide = document.scrollingElement.scrollWidth;
    const screen_px = Math.min(window.innerWidth, screen.width); // a phone shows a page that is too wide as a whole
    if (wide > screen_px) problems.push(`the page is ${wide} px wide on a screen of ${screen_px}`);
    for (const plot of document.querySelectorAll('.section .plot, .section .legend'))
      if (!plot.querySelector('svg path, svg circle, svg line'))
        problems.push(`an empty plot in ${plot.closest('section').id}`);
    for (const body of document.querySelectorAll('.section .section-body'))
      if (!body.children.length) problems.push(`an empty section: ${body.closest('section').id}`);
    for (const box of document.querySelectorAll('.section .table-scroll')) {
      if (box.closest('details:not([open])') || box.scrollWidth <= box.clientWidth + 2) continue;
      const table = `the table ${box.querySelector('table').id || box.querySelector('table').className}`;
      const frame = box.parentElement;
      const last = [...box.querySelectorAll('thead th')].pop();
      const name = (last.querySelector('.header') || last).textContent;
      const first = [...box.querySelectorAll('tbody tr > :first-child:not([colspan])')];
      if (window.innerWidth > 1200) problems.push(`${table} is cut: ${box.scrollWidth} px in ${box.clientWidth}`);
      if (!frame.classList.contains('more-right'))
        problems.push(`${table} goes on behind an edge that does not say so`);
      else if (!frame.querySelector('.more-columns').textContent.includes(name))
        problems.push(`${table} has no line that names its hidden columns`);
      if (first.some((cell) => getComputedStyle(cell).position !== 'sticky'))
        problems.push(`${table} loses its first column when it scrolls`);
    }
    for (const facet of document.querySelectorAll('.facet')) {
      const [title, button] = [facet.querySelector('h4'), facet.querySelector('.figure-tools')];
      if (!title || !button) continue;
      const words = document.createRange();
      words.selectNodeContents(title);
      const of = button.getBoundingClientRect();
      const covers = (line) => line.right > of.left && line.left < of.right && line.bottom > of.top && line.top < of.bottom;
      if ([...words.getClientRects()].some(covers)) problems.push(`a button covers the title '${title.textContent}'`);
    }
    for (const attribute of document.querySelectorAll('svg [d], svg [transform], svg [x], svg [x1], svg [cx]'))
      for (const {name, value} of attribute.attributes)
        if (/NaN|undefined/.test(value)) problems.push(`${name}="${value}" in ${attribute.closest('section').id}`);
    for (const text of document.querySelectorAll('.page-head, .section p, .section th, .section td'))
      if (/\bNaN\b|\[object|\bnull\b/.test(text.textContent))
        problems.push(`'${text.textContent}' is no readable text`);
    return problems;
  });
  assert.deepStrictEqual(found, [], where);
}

// The JSON of a replay in a report, changed by `change`, in a copy of the report.
function with_replay(report, element, change) {
  const text = fs.readFileSync(report, 'utf8');
  const tag = `<script type="application/gzip" id="${element}">`;
  const from = text.indexOf(tag) + tag.length;
  const to = text.indexOf('</script>', from);
  const replay = JSON.parse(zlib.gunzipSync(Buffer.from(text.slice(from, to), 'base64')));
  change(replay);
  const file = path.join(path.dirname(report), 'changed_replay.html');
  const packed = zlib.gzipSync(JSON.stringify(replay)).toString('base64');
  fs.writeFileSync(file, text.slice(0, from) + packed + text.slice(to));
  return file;
}

// Writes a copy of a report with changed data, for cases that no quick run produces.
function with_data(report, change) {
  const text = fs.readFileSync(report, 'utf8');
  const [, before, json, after] = text.match(
    /^([^]*<script type="application\/json" id="dmrp-data">)([^]*?)(<\/script>[^]*)$/
  );
  const data = JSON.parse(json);
  change(data);
  const file = path.join(path.dirname(report), 'changed.html');
  fs.writeFileSync(file, before + JSON.stringify(data).replace(/</g, '\\u003c') + after);
  return file;
}

// The images of a PDF: [{width, height, colours}], the number of different ones of the rows of pixels read as RGB.
function images_of(pdf) {
  const text = pdf.toString('latin1');
  return [...text.matchAll(/<<[^<>]*\/Subtype \/Image[^<>]*>>\s*stream\n/g)]
    .filter(([head]) => head.includes('/FlateDecode'))
    .map((found) => {
      const number = (key) => Number(found[0].match(new RegExp(`/${key} (\\d+)`))[1]);
      const from = found.index + found[0].length;
      const pixels = zlib.inflateSync(pdf.subarray(from, from + number('Length')));
      const colours = new Set();
      for (let i = 0; i + 3 <= pixels.length; i += 3) colours.add(pixels.readUIntBE(i, 3));
      return {width: number('Width'), height: number('Height'), colours: colours.size};
    });
}

function pages_of(pdf) {
  return pdf.toString('latin1').match(/\/Type \/Page\b(?!s)/g).length;
}

// The mean colour of what an element looks like, [red, green, blue].
async function painted_colour(page, locator) {
  const picture = (await locator.screenshot()).toString('base64');
  return page.evaluate(async (png) => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const pixels = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    const mean = [0, 0, 0];
    for (let i = 0; i < pixels.length; ++i) if (i % 4 < 3) mean[i % 4] += pixels[i] / (pixels.length / 4);
    return mean;
  }, picture);
}

function read_csv(file) {
  const [head, ...lines] = fs
    .readFileSync(file, 'utf8')
    .trim()
    .split('\n')
    .map((line) => line.split(','));
  return lines.map((line) => Object.fromEntries(head.map((name, i) => [name, line[i]])));
}

// Runs async tests in sequence and ends the process.
async function run_tests(tests) {
  const browser = await launch();
  let failed = 0;
  for (const [name, run] of Object.entries(tests)) {
    try {
      await run(browser);
    } catch (error) {
      ++failed;
      console.error(`FAILED: ${name}\n${error.stack}`);
    }
  }
  await browser.close();
  console.log(`${Object.keys(tests).length - failed} of ${Object.keys(tests).length} passed`);
  process.exit(failed > 0 ? 1 : 0);
}

module.exports = {
  LAPTOP,
  PHONE,
  browser_or_skip,
  run_experiment,
  scratch_folder,
  with_data,
  with_replay,
  open_report,
  shared_report,
  close,
  check_layout,
  images_of,
  pages_of,
  painted_colour,
  read_csv,
  run_tests,
};
