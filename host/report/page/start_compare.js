// SPDX-License-Identifier: MIT
// start_compare.js: reads the data of a comparison and fills its page: a section for each later run.
import {element} from './elements.js';
import * as differences from './compare/differences.js';
import * as overview from './compare/overview.js';
import * as what_changed from './compare/what_changed.js';
import * as theme from './theme.js';
import * as tips from './tips.js';
import './page.css';

// The parts of a run's section, each with the title of its own.
const PARTS = [
  ['All trials', differences.mount_metrics],
  ['By combination', differences.mount_combinations],
  ['What differs between the runs', what_changed.mount],
];

function section(data, run, index) {
  const id = (part) => `run-${index}${part === 0 ? '' : `-${part}`}`;
  return PARTS.map(([title, mount], part) => {
    const body = element('div', {class: 'section-body'});
    const words = data.runs.length > 1 ? `${title}: ${run.path}` : title;
    const made = element('section', {class: 'section ready', id: id(part)}, element('h2', {}, words), body);
    document.querySelector('main').append(made);
    mount(body, data, run);
    return made;
  });
}

// window.dmrp offers the data to tests and other scripts.
function begin() {
  theme.follow_system();
  theme.follow_printing();
  tips.explain_on_demand();
  const data = JSON.parse(document.getElementById('dmrp-data').textContent);
  window.dmrp = {data};
  overview.mount(document.getElementById('overview'), data);
  data.runs.forEach((run, index) => section(data, run, index));
}

document.addEventListener('DOMContentLoaded', begin);
