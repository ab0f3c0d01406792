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
import * as theme from './theme.js';
import './page.css';

// Each function fills the body of its section. If there are no data it returns the reason: the section is removed and
// the reason listed at the end of the page.
function parts() {
  return [
    ['answer', answer.mount],
    ['tables', result_tables.mount],
    ['graded', graded_tests.mount],
    ['failures', failures.mount],
    ['heat-map', heat_map.mount],
    ['distributions', distributions.mount],
    ['replay', (body, data) => player.mount(body, data, make_3d_view)],
    ['diagnosis', diagnosis.mount],
    ['comparisons', comparisons.mount],
    ['curves', threshold_curves.mount],
    ['completion', completion.mount],
    ['pedestrian-delay', pedestrian_delay.mount],
    ['faults', faults.mount],
    ['metrics', metrics_table.mount],
    ['provenance', provenance.mount],
  ];
}

function mount_part(part, data) {
  if (part.done) return;
  part.done = true;
  const body = part.section.querySelector('.section-body');
  let reason = null;
  try {
    reason = part.mount(body, data);
  } catch (error) {
    // an error in one section must not stop the others
    console.error(error);
    fill(body, element('p', {class: 'note'}, `This section could not be shown: ${error.message}`));
  }
  part.section.classList.add('ready');
  if (typeof reason !== 'string') return;
  const list = document.getElementById('left-out');
  list.hidden = false;
  list.append(element('li', {}, `${part.section.querySelector('h2').textContent}: ${reason}.`));
  part.section.remove();
  part.link.remove();
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
}

// Scrolls the list horizontally; the page must not move.
function bring_into_sight(link) {
  const list = link.parentElement;
  const room = list.clientWidth - link.offsetWidth;
  if (link.offsetLeft < list.scrollLeft || link.offsetLeft > list.scrollLeft + room)
    list.scrollLeft = link.offsetLeft - room / 2;
}

// Marks the current section in the contents.
function follow_reading(all) {
  const seen = new Set();
  const observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) entry.isIntersecting ? seen.add(entry.target) : seen.delete(entry.target);
      const current = all.find((part) => seen.has(part.section));
      for (const part of all) {
        if (part === current) part.link.firstChild.setAttribute('aria-current', 'true');
        else part.link.firstChild.removeAttribute('aria-current');
      }
      if (current) bring_into_sight(current.link);
    },
    {rootMargin: '-30% 0px -60% 0px'}
  );
  for (const part of all) observer.observe(part.section);
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

// Sections above the target of a jump are filled first, since they grow.
function mount_before_jumps(all, data) {
  document.addEventListener('click', (event) => {
    const link = event.target.closest('a[href^="#"]');
    if (link) mount_up_to(all, data, link.getAttribute('href').slice(1));
  });
}

function mount_up_to(all, data, id) {
  for (const part of all) {
    mount_part(part, data);
    if (part.section.id === id) break;
  }
}

function open_replay(all, data, trial) {
  mount_up_to(all, data, 'replay');
  document.getElementById('replay').scrollIntoView({block: 'start'});
  return player.open(trial);
}

// window.dmrp offers the data and open_replay(trial) to tests and other scripts.
function begin() {
  theme.follow_system();
  theme.follow_printing();
  const data = JSON.parse(document.getElementById('dmrp-data').textContent);
  overview.mount(document.getElementById('overview'), data);
  const all = parts().map(([id, mount]) => ({section: document.getElementById(id), mount, done: false}));
  fill_contents(all);
  document.addEventListener('dmrp:open-replay', (event) => open_replay(all, data, event.detail));
  window.dmrp = {data, open_replay: (trial) => open_replay(all, data, trial)};
  mount_up_to(all, data, 'tables');
  mount_before_jumps(all, data);
  if (window.location.hash) mount_up_to(all, data, window.location.hash.slice(1));
  mount_when_near(all, data);
  follow_reading(all);
  mount_when_idle(all, data);
  window.addEventListener('beforeprint', () => mount_up_to(all, data, null));
}

document.addEventListener('DOMContentLoaded', begin);
