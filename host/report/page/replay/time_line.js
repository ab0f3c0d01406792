// SPDX-License-Identifier: MIT
// time_line.js: the time slider of a replay, and above it the events, one row for each kind.
import {element} from '../elements.js';
import * as labels from '../labels.js';

const LANE_PX = 14;
const MOST_MARKS = 400; // in a row; more could not be distinguished

function lane_title(data, lane) {
  return ['contacts', 'robots', 'plans'].includes(lane) ? lane : labels.metric_title(data, lane);
}

function lanes_of(events) {
  const order = [
    'contacts',
    ...labels.distinct(events.filter((event) => event.kind === 'metric').map((event) => event.lane)),
    'plans',
    'robots',
  ];
  return order
    .map((name) => ({name, events: events.filter((event) => event.lane === name)}))
    .filter((lane) => lane.events.length > 0);
}

function mark(event, x, width) {
  const title = document.createElementNS('http://www.w3.org/2000/svg', 'title');
  title.textContent = `${event.from.toFixed(1)} s: ${event.text}`;
  const middle = LANE_PX / 2;
  const shapes = {
    contact: `M${x - 4},${middle - 4}l8,8m0,-8l-8,8`,
    arrival: `M${x - 4},${middle}l3,3.5l5.5,-7`,
    failure: `M${x - 3.5},${middle - 3.5}h7v7h-7z`,
    plan: `M${x},${middle - 5}v10`,
    metric: width > 3 ? `M${x},${middle}h${width}` : `M${x - 1.5},${middle}h3`,
  };
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', shapes[event.kind]);
  path.setAttribute('class', `replay-mark ${event.kind}`);
  path.append(title);
  return path;
}

function lane_row(data, lane, width, end, jump) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('width', width);
  svg.setAttribute('height', LANE_PX);
  svg.setAttribute('aria-hidden', 'true'); // the list of events says the same
  const scale = width / (end || 1);
  for (const event of lane.events.slice(0, MOST_MARKS)) {
    const drawn = mark(event, event.from * scale, (event.to - event.from) * scale);
    drawn.addEventListener('click', () => jump(event));
    svg.append(drawn);
  }
  return [
    element('span', {class: 'replay-lane'}, lane_title(data, lane.name)),
    element('div', {class: 'replay-marks'}, svg),
  ];
}

// handlers: jump(event), go(t).
export function make_time_line(data, handlers) {
  const slider = element('input', {
    type: 'range',
    min: 0,
    max: 0,
    step: 0.1,
    value: 0,
    class: 'replay-slider',
    'aria-label': 'time in the trial',
    'data-testid': 'replay-scrub',
  });
  const readout = element('output', {class: 'replay-time number', 'data-testid': 'replay-time'});
  const rows = element('div', {class: 'replay-lanes'});
  const node = element('div', {class: 'replay-time-line'}, rows, readout, slider);
  let replay = null;
  let events = [];

  slider.addEventListener('input', () => handlers.go(Number(slider.value)));

  function resize() {
    if (!replay) return;
    const width = Math.max(50, slider.clientWidth - 16); // the travel of the thumb's centre
    rows.textContent = '';
    for (const lane of lanes_of(events)) rows.append(...lane_row(data, lane, width, replay.end, handlers.jump));
  }

  function show(shown, its_events) {
    replay = shown;
    events = its_events;
    slider.max = replay.end.toFixed(2);
    resize();
  }

  function draw(t) {
    slider.value = t;
    const share = replay.end > 0 ? (100 * t) / replay.end : 0;
    slider.style.setProperty('--done', `${share}%`);
    readout.textContent = `${t.toFixed(1)} s`;
    slider.setAttribute('aria-valuetext', `${t.toFixed(1)} of ${replay.end.toFixed(1)} seconds`);
  }

  return {node, show, draw, resize};
}
