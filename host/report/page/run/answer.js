// SPDX-License-Identifier: MIT
// answer.js: which combination is better: the answer's first sentence at the top of the page; the others, and the order
// that they come from, below the tables. answer.hpp has the rules; nothing is computed here.
import * as controls from '../controls.js';
import {element, fill, head_row, hidden, number_head} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {scroll_box} from '../scroll_box.js';

const DECIMALS = 2;
const STANDINGS = {first: 'first, may be the best', may_be_best: 'may be the best', worse: 'not the best'};

// "mall · 4 robots": what an answer is about, if it is not about everything.
export function scope_words(data, answer) {
  if (answer.cells.length !== 1) return 'all';
  const [cell] = answer.cells;
  const differ_in = (field) => labels.distinct(data.answers.flatMap((one) => one.cells.map((of) => of[field]))).length > 1;
  return [
    cell.scenario,
    differ_in('robots') && numbers.counted(cell.robots, 'robot'),
    differ_in('pedestrian_model') && labels.named(cell.pedestrian_model),
  ]
    .filter(Boolean)
    .join(' · ');
}

// The difference to the first in a criterion: "−0.25 [−0.35, −0.15]"; "=" where no pair differs.
export function difference_words(against) {
  if (against.n === 0) return numbers.UNDEFINED;
  if (against.equal) return '=';
  const interval = numbers.interval(against.low, against.high, DECIMALS, numbers.signed);
  return [numbers.signed(against.mean, DECIMALS), interval].filter(Boolean).join(' ');
}

function criterion_cell(one, c) {
  const against = one.against[c];
  return element(
    'td',
    {class: one.decided === c ? 'number decided' : 'number'},
    element('span', {class: 'mean'}, numbers.fixed(one.means[c], DECIMALS)),
    element('span', {class: 'interval'}, numbers.interval(...one.intervals[c], DECIMALS)),
    against &&
      element(
        'span',
        {class: 'against', 'data-about': `difference to the first, over n = ${against.n}`},
        one.decided === c && hidden('decides: '),
        difference_words(against)
      )
  );
}

function row(one) {
  return element(
    'tr',
    {class: one.standing.replace(/_/g, '-')},
    element('th', {scope: 'row'}, `${one.global_planner} + ${one.local_controller}`),
    one.means.map((_, c) => criterion_cell(one, c)),
    element('td', {}, STANDINGS[one.standing], one.pareto && element('span', {class: 'given'}, ' · not beaten in all'))
  );
}

function table(answer) {
  const heads = answer.criteria.map(({name, unit}) => number_head(name, numbers.unit(unit) || '\u2013'));
  return element(
    'table',
    {class: 'ranking'},
    head_row(
      element('th', {scope: 'col'}, 'planner + controller'),
      heads,
      element('th', {scope: 'col'}, 'of these')
    ),
    element('tbody', {}, answer.ranking.map(row))
  );
}

const KEY =
  'Those that may be the best come first; with 95 % confidence the best is among them. The criteria count from left to ' +
  'right: in the next, one is compared with those to which it was shown not to be inferior by 5 points or half a second. ' +
  'Time is that of arrival over the length of the robot\u2019s shortest way, of robots that arrived. Below each mean: its ' +
  '95 % interval, and the paired difference to the first. Framed: what tells that it is not the best.';

function first_element(answer) {
  return [
    element('p', {class: 'answer-first'}, answer.lines[0]),
    element('p', {class: 'note'}, `${answer.heading}.`),
  ];
}

function order_element(answer) {
  return [
    element('ul', {class: 'answer-lines'}, answer.lines.slice(1).map((line) => element('li', {}, line))),
    element('h3', {class: 'order-title'}, `The order of ${numbers.counted(answer.ranking.length, 'combination')}`),
    scroll_box({'aria-label': 'Order'}, table(answer)),
    element('p', {class: 'note'}, KEY),
  ];
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.answers.length > 0 ? null : 'there is one combination, or its success was not measured';
}

function mount_with(body, data, made) {
  const holder = element('div', {class: 'answer'});
  const show = (index) => fill(holder, made(data.answers[Number(index)]));
  const options = data.answers.map((answer, i) => ({value: String(i), label: scope_words(data, answer)}));
  const choose = (options.length <= 4 ? controls.segmented : controls.select)('Scenario', options, '0', show);
  show(0);
  fill(body, choose && controls.row(choose), holder);
}

export function mount(body, data) {
  mount_with(body, data, first_element);
}

export function mount_order(body, data) {
  mount_with(body, data, order_element);
}
