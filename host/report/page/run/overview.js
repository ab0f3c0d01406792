// SPDX-License-Identifier: MIT
// overview.js: the head of the page, with the run's verdict; and its section "The run": main figures, scenarios, choices.
import {element, fill, hidden} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as theme from '../theme.js';
import * as verdict from './verdict.js';

// 21 November 2026, 22:59 UTC
export function date_words(iso) {
  const date = new Date(iso);
  if (Number.isNaN(date.getTime())) return iso;
  const day = date.toLocaleDateString('en-GB', {day: 'numeric', month: 'long', year: 'numeric', timeZone: 'UTC'});
  return `${day}, ${date.toISOString().slice(11, 16)} UTC`;
}

function range_words(counts, noun, plural = noun + 's') {
  const low = Math.min(...counts);
  const high = Math.max(...counts);
  return low === high ? numbers.counted(low, noun, plural) : `${low} to ${high} ${plural}`;
}

function subtitle(data) {
  const names = labels.distinct(data.scenarios.map((scenario) => scenario.name));
  return [
    names.join(', '),
    range_words(
      data.scenarios.map((scenario) => scenario.robots),
      'robot'
    ),
    range_words(
      data.scenarios.map((scenario) => scenario.people),
      'person',
      'people'
    ),
    numbers.counted(data.combinations.length, 'combination'),
    `${numbers.counted(data.run.repetitions, 'trial')} each`,
  ].join(' · ');
}

const MARKS = {bad: '✕', warning: '!', note: 'i', good: '✓'};
const KINDS = {bad: 'Problem: ', warning: 'Warning: ', note: 'Note: ', good: ''};

function verdict_list(data) {
  const list = element('ul', {class: 'verdict'});
  for (const line of verdict.lines(data)) {
    const link = line.section && element('a', {href: `#${line.section}`}, 'Show');
    list.append(
      element(
        'li',
        {class: line.kind},
        element('span', {class: 'mark', 'aria-hidden': 'true'}, MARKS[line.kind]),
        element('span', {}, hidden(KINDS[line.kind]), line.text, link && ' ', link)
      )
    );
  }
  return list;
}

function figure(value, of, title) {
  return element(
    'div',
    {class: 'figure'},
    element('dt', {}, title),
    element('dd', {}, value, of && element('span', {class: 'of'}, ` ${of}`))
  );
}

function figures(data) {
  const t = verdict.tally(data);
  const show = (count) => count.toLocaleString('en');
  return element(
    'dl',
    {class: 'figures'},
    figure(show(t.ran), t.ran === t.planned ? '' : `of ${show(t.planned)}`, t.ran === 1 ? 'trial' : 'trials'),
    t.robots > 0 && figure(show(t.arrived), `of ${show(t.robots)}`, 'robots arrived'),
    t.contacts !== null && figure(show(t.contacts), '', t.contacts === 1 ? 'contact' : 'contacts'),
    figure(show(t.faults), '', t.faults === 1 ? 'fault' : 'faults'),
    figure(numbers.duration(t.simulated_s), `in ${numbers.duration(t.wall_s)}`, 'simulated, wall time of the trials')
  );
}

function scenario_list(data) {
  const list = element('dl', {class: 'scenarios'});
  for (const scenario of data.scenarios) {
    const robots = scenario.robots === 0 ? 'without robots, as a reference' : numbers.counted(scenario.robots, 'robot');
    list.append(
      element('dt', {}, `${scenario.name} · ${robots}, ${numbers.counted(scenario.people, 'person', 'people')}`),
      element('dd', {}, scenario.description)
    );
  }
  return list;
}

function choices(data) {
  const list = element('dl', {class: 'choices'});
  const add = (title, text) => list.append(element('dt', {}, title), element('dd', {}, text));
  for (const [field, title] of Object.entries(labels.FIELD_TITLES)) {
    const values = labels.values_of(data, field).map(labels.named);
    add(title + (values.length === 1 ? '' : 's'), values.join(', '));
  }
  add('seed', data.run.seed);
  add('run', `${date_words(data.run.started)} by dmrp ${data.run.version}`);
  return list;
}

export function mount_head(body, data) {
  document.title = `${data.run.name} · dmrp report`;
  fill(
    body,
    element(
      'div',
      {class: 'title-line'},
      element('div', {}, element('h1', {}, data.run.name), element('p', {class: 'subtitle'}, subtitle(data))),
      theme.button()
    ),
    verdict_list(data)
  );
}

export function mount(body, data) {
  fill(body, figures(data), element('div', {class: 'what-was-run'}, scenario_list(data), choices(data)));
}
