// SPDX-License-Identifier: MIT
// lists.js: the lists beside the map: robots with their current state, and events.
import {element, head_row} from '../elements.js';
import * as numbers from '../numbers.js';
import {explained_mark} from '../tips.js';
import {is_now} from './events.js';
import * as look from './look.js';
import * as recording from './recording.js';

const UPDATE_S = 0.1; // time between updates of the text, in simulated time

// Returns a function that says whether the text is due for an update: paused, or UPDATE_S after the last one.
function make_pace() {
  let last = null;
  return (t, is_playing) => {
    const due = !is_playing || last === null || Math.abs(t - last) >= UPDATE_S;
    if (due) last = t;
    return due;
  };
}

function state_words(robot, k) {
  if (robot.state[k] === recording.FINISHED) return 'arrived';
  if (robot.state[k] === recording.FAILED) return robot.failure ? `failed: ${robot.failure}` : 'failed';
  return robot.goals.length > 1
    ? `to goal ${Math.min(robot.goal[k] + 1, robot.goals.length)} of ${robot.goals.length}`
    : 'driving';
}

// handlers: pick(robot index), point(robot index or null).
export function make_robot_list(handlers) {
  const body = element('tbody');
  const node = element(
    'div',
    {class: 'replay-robots'},
    element(
      'table',
      {},
      head_row(
        element('th', {scope: 'col'}, 'Robot'),
        element('th', {scope: 'col'}, 'State'),
        element('th', {scope: 'col', class: 'number'}, 'm/s'),
        element('th', {scope: 'col', class: 'number'}, explained_mark('off path (m)', 'distance from its current path'))
      ),
      body
    )
  );
  let rows = [];
  let replay = null;
  const is_due = make_pace();

  function robot_row(robot) {
    const number = element(
      'span',
      {class: 'replay-number', style: `--colour: ${look.robot_variable(robot.index)}`},
      String(robot.index)
    );
    const button = element(
      'button',
      {
        type: 'button',
        class: 'replay-robot',
        'aria-pressed': 'false',
        'data-testid': `replay-robot-${robot.index}`,
        'aria-label': `robot ${robot.index}, ${robot.name}`,
        onclick: () => handlers.pick(robot.index),
      },
      number,
      element('span', {class: 'replay-robot-name'}, robot.name)
    );
    const cells = {
      state: element('td'),
      speed: element('td', {class: 'number'}),
      deviation: element('td', {class: 'number'}),
    };
    return {
      button,
      cells,
      row: element(
        'tr',
        {onpointerenter: () => handlers.point(robot.index), onpointerleave: () => handlers.point(null)},
        element('th', {scope: 'row'}, button),
        cells.state,
        cells.speed,
        cells.deviation
      ),
    };
  }

  function show(shown) {
    replay = shown;
    rows = replay.robots.map(robot_row);
    body.textContent = '';
    body.append(...rows.map((one) => one.row));
  }

  function write(cell, text) {
    if (cell.textContent !== text) cell.textContent = text;
  }

  function draw(at, is_playing) {
    if (!is_due(at.t, is_playing)) return;
    rows.forEach(({cells}, i) => {
      const robot = replay.robots[i];
      write(cells.state, state_words(robot, at.k));
      write(cells.speed, at.k < robot.speed.length ? numbers.fixed(robot.speed[at.k], 2) : numbers.UNDEFINED);
      write(
        cells.deviation,
        at.k < robot.deviation.length ? numbers.fixed(robot.deviation[at.k], 2) : numbers.UNDEFINED
      );
    });
  }

  function mark({picked, hovered}) {
    rows.forEach(({button, row}, i) => {
      button.setAttribute('aria-pressed', String(i === picked));
      row.classList.toggle('marked', i === picked || i === hovered);
    });
  }

  return {node, show, draw, mark};
}

const SYMBOLS = {
  contact: '✕',
  arrival: '✓',
  failure: '■',
  plan: '↻',
  metric: '▬',
};

// handlers: jump(event).
export function make_event_list(handlers) {
  const list = element('ol', {class: 'replay-events', 'data-testid': 'replay-events'});
  const nothing = element('p', {class: 'note'}, 'This trial has no events.');
  const node = element('div', {class: 'replay-event-list'}, element('h3', {}, 'Events'), list, nothing);
  const is_due = make_pace();
  let buttons = [];
  let events = [];

  function show(its_events) {
    events = its_events;
    list.textContent = '';
    nothing.hidden = events.length > 0;
    list.hidden = events.length === 0;
    buttons = events.map((event) =>
      element(
        'button',
        {type: 'button', class: `replay-event ${event.kind}`, onclick: () => handlers.jump(event)},
        element('span', {class: 'number'}, `${event.from.toFixed(1)} s`),
        element('span', {class: 'replay-symbol', 'aria-hidden': 'true'}, SYMBOLS[event.kind]),
        element(
          'span',
          {},
          event.text,
          event.to - event.from >= 0.1
            ? element('span', {class: 'soft'}, ` for ${(event.to - event.from).toFixed(1)} s`)
            : null
        )
      )
    );
    buttons.forEach((button) => list.append(element('li', {}, button)));
  }

  function draw(t, is_playing) {
    if (!is_due(t, is_playing)) return;
    buttons.forEach((button, i) => button.classList.toggle('now', is_now(events[i], t)));
  }

  return {node, show, draw};
}
