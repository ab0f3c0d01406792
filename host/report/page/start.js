// SPDX-License-Identifier: MIT
// start.js: reads the data and fills the page. The head, the answer and the tables come at once, the others when the reader
// scrolls near them or when the browser is idle, so that the report of a large run opens quickly.
import {element, fill} from './elements.js';
import * as completion from './plots/completion.js';
import * as diagnosis from './plots/diagnosis.js';
import * as distributions from './plots/distributions.js';
import * as threshold_curves from './plots/threshold_curves.js';
import * as player from './replay/player.js';
import {make_view as make_3d_view} from './replay_3d/view.js';
import * as answer from './run/answer.js';
import * as failures from './run/failures.js';
import * as faults from './run/faults.js';
import * as overview from './run/overview.js';
import * as provenance from './run/provenance.js';
import * as comparisons from './tables/comparisons.js';
import * as graded_tests from './tables/graded_tests.js';
import * as heat_map from './tables/heat_map.js';
import * as metrics_table from './tables/metrics_table.js';
import * as pedestrian_delay from './tables/pedestrian_delay.js';
import * as result_tables from './tables/result_tables.js';
import {watch_edges} from './scroll_box.js';
import * as theme from './theme.js';
import * as tips from './tips.js';
import './page.css';

// mount(body, data) of a section's module fills its body; absent(data), if there is one, says why it would stay empty.
function parts() {
  return [
    ['answer', answer],
    ['tables', result_tables],
    ['graded', graded_tests],
    ['order', {absent: answer.absent, mount: answer.mount_order}],
    ['failures', failures],
    ['heat-map', heat_map],
    ['distributions', distributions],
    ['replay', {absent: player.absent, mount: (body, data) => player.mount(body, data, make_3d_view)}],
    ['comparisons', comparisons],
    ['completion', completion],
    ['pedestrian-delay', pedestrian_delay],
    ['faults', faults],
    ['run', overview],
    ['diagnosis', diagnosis],
    ['curves', threshold_curves],
    ['metrics', metrics_table],
    ['provenance', provenance],
  ].map(([id, module]) => ({...module, section: document.getElementById(id), done: false}));
}

function reason_of_absence(part, data) {
  try {
    return part.absent ? part.absent(data) : null;
  } catch (error) {
    return null; // mounting the section shows the error
  }
}

// Removes the sections without data and lists the reasons at the end of the page, before anything is shown, so that
// the contents never change under the reader's pointer. Returns the others.
function with_data(all, data) {
  const list = document.getElementById('left-out');
  return all.filter((part) => {
    const reason = reason_of_absence(part, data);
    if (reason === null) return true;
    list.hidden = false;
    list.append(element('li', {}, `${part.section.querySelector('h2').textContent}: ${reason}.`));
    part.section.remove();
    return false;
  });
}

function mount_part(part, data) {
  if (part.done) return;
  part.done = true;
  const body = part.section.querySelector('.section-body');
  try {
    part.shown = part.mount(body, data);
  } catch (error) {
    // an error in one section must not stop the others
    console.error(error);
    fill(body, element('p', {class: 'note'}, `This section could not be shown: ${error.message}`));
  }
  part.section.classList.add('ready');
}

function fill_contents(all) {
  const contents = document.getElementById('contents');
  const list = element('ol');
  for (const part of all) {
    const title = part.section.querySelector('h2').textContent;
    part.link = element('li', {}, element('a', {href: `#${part.section.id}`}, title));
    list.append(part.link);
  }
  contents.append(list);
  watch_edges(contents, list);
}

// Scrolls the list horizontally; the page must not move.
function bring_into_sight(link) {
  const list = link.parentElement;
  const room = list.clientWidth - link.offsetWidth;
  if (link.offsetLeft < list.scrollLeft || link.offsetLeft > list.scrollLeft + room)
    list.scrollLeft = link.offsetLeft - room / 2;
}

function mark_current(all, current) {
  for (const part of all) {
    if (part === current) part.link.firstChild.setAttribute('aria-current', 'true');
    else part.link.firstChild.removeAttribute('aria-current');
  }
  if (current) bring_into_sight(current.link);
}

// Marks the current section in the contents: the one that was jumped to, or the first that is seen.
function follow_reading(all, anchor) {
  const seen = new Set();
  const observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) entry.isIntersecting ? seen.add(entry.target) : seen.delete(entry.target);
      if (!anchor.held()) mark_current(all, all.find((part) => seen.has(part.section)));
    },
    {rootMargin: '-30% 0px -60% 0px'}
  );
  for (const part of all) observer.observe(part.section);
}

const HELD_MS = 4000; // by then, all sections have been filled

// Keeps the section that was jumped to at the top of the window while sections above it are filled and grow. Ends when
// the reader scrolls, points or types.
function make_anchor() {
  let section = null;
  let timer = 0;
  const release = () => {
    section = null;
    clearTimeout(timer);
  };
  const align = () => section && section.scrollIntoView({block: 'start', behavior: 'instant'});
  for (const kind of ['wheel', 'touchstart', 'pointerdown', 'keydown'])
    window.addEventListener(kind, release, {passive: true, capture: true});
  new ResizeObserver(align).observe(document.querySelector('main'));
  return {
    held: () => section,
    hold: (target) => {
      release();
      section = target;
      timer = setTimeout(release, HELD_MS);
      align();
    },
  };
}

function mount_when_near(all, data) {
  const observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries)
        if (entry.isIntersecting)
          mount_part(
            all.find((part) => part.section === entry.target),
            data
          );
    },
    {rootMargin: '600px'}
  );
  for (const part of all) observer.observe(part.section);
}

function mount_when_idle(all, data) {
  const next = all.find((part) => !part.done);
  if (!next) return;
  const idle = window.requestIdleCallback || ((run) => setTimeout(run, 50));
  idle(
    () => {
      mount_part(next, data);
      mount_when_idle(all, data);
    },
    {timeout: 1000}
  );
}

// Delays the window's load event, and with it printing by a program, until `shown`: an open document holds it back.
function load_with(shown) {
  const frame = element('iframe', {hidden: true});
  document.body.append(frame);
  frame.contentDocument.open();
  shown.finally(() => {
    frame.contentDocument.close();
    frame.remove();
  });
}

function mount_up_to(all, data, id) {
  for (const part of all) {
    mount_part(part, data);
    if (part.section.id === id) break;
  }
}

// Sections above the target are filled first, since they grow.
function jump_to(all, data, anchor, id) {
  const target = all.find((part) => part.section.id === id);
  if (!target) return;
  mount_up_to(all, data, id);
  anchor.hold(target.section);
  mark_current(all, target);
}

function open_replay(all, data, anchor, trial) {
  jump_to(all, data, anchor, 'replay');
  return player.open(trial);
}

// window.dmrp offers the data and open_replay(trial) to tests and other scripts.
function begin() {
  theme.follow_system();
  theme.follow_printing();
  tips.explain_on_demand();
  const data = JSON.parse(document.getElementById('dmrp-data').textContent);
  overview.mount_head(document.getElementById('overview'), data);
  const all = with_data(parts(), data);
  const anchor = make_anchor();
  fill_contents(all);
  document.addEventListener('dmrp:open-replay', (event) => open_replay(all, data, anchor, event.detail));
  document.addEventListener('click', (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link) jump_to(all, data, anchor, link.getAttribute('href').slice(1));
  });
  window.dmrp = {data, open_replay: (trial) => open_replay(all, data, anchor, trial)};
  mount_up_to(all, data, 'tables');
  const replay = all.find((part) => part.section.id === 'replay');
  if (replay) mount_part(replay, data);
  if (replay && replay.shown) load_with(replay.shown);
  jump_to(all, data, anchor, window.location.hash.slice(1));
  mount_when_near(all, data);
  follow_reading(all, anchor);
  mount_when_idle(all, data);
  window.addEventListener('beforeprint', () => mount_up_to(all, data, null));
}

document.addEventListener('DOMContentLoaded', begin);
