// SPDX-License-Identifier: MIT
// trial_points.js: points that represent trials. The reader selects them by pointer or keys and opens the replay.
import {element, fill} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as ranking from '../ranking.js';
import * as tips from '../tips.js';
import * as plots from './plots.js';

// A number in [-1, 1) that depends on the trial alone, so that a plot always looks the same. `axis`: 0 or 1, for two
// independent numbers.
export function jitter(id, axis = 0) {
  let hash = Math.imul(id + 1, axis === 0 ? 0x9e3779b1 : 0x27d4eb2f);
  hash = Math.imul(hash ^ (hash >>> 15), 0x85ebca6b);
  hash = Math.imul(hash ^ (hash >>> 13), 0xc2b2ae35);
  return ((hash ^ (hash >>> 16)) >>> 0) / 2147483648 - 1;
}

function has_replay(data, id) {
  return data.replays.some((replay) => replay.trial === id);
}

// start.js opens the replay.
function open_replay(id) {
  document.dispatchEvent(new CustomEvent('dmrp:open-replay', {detail: id}));
}

function value_words(data, row, metric) {
  const value = data.values[metric][row];
  const about = labels.metric(data, metric);
  return (
    `${labels.metric_title(data, metric)} ` +
    (ranking.is_defined(value) ? numbers.with_unit(numbers.general(value), about.unit) : 'undefined')
  );
}

const OUTCOMES = {
  succeeded: 'all robots arrived',
  failed: 'not all robots arrived',
  fault: 'ended in a fault',
  skipped: 'skipped',
  unsupported: 'not for a plugin',
};

function tip_of(data, row, metrics) {
  return [
    element('strong', {}, labels.trial(data, row)),
    element('br'),
    metrics.map((metric) => value_words(data, row, metric)).join(', '),
    element('br'),
    OUTCOMES[data.trials.outcome[row]],
    has_replay(data, data.trials.id[row]) && [element('br'), 'Click to open the replay'],
  ];
}

// The line below a plot about the selected trial.
function detail_of(data, row, metrics) {
  const id = data.trials.id[row];
  const words =
    `${labels.trial(data, row)} · repetition ${data.trials.repetition[row]} · seed ${data.trials.seed[row]} · ` +
    `${metrics.map((metric) => value_words(data, row, metric)).join(', ')} · ${OUTCOMES[data.trials.outcome[row]]}`;
  return [
    element('span', {class: 'number'}, words),
    has_replay(data, id)
      ? element('button', {type: 'button', class: 'button small', onclick: () => open_replay(id)}, 'Open the replay')
      : element('span', {class: 'none'}, 'no replay in this report'),
  ];
}

// The next of `points` ({x, y}) in the direction of an arrow key: left and right along the row, up and down to the
// nearest row.
export function neighbour(points, current, key) {
  if (current < 0) return points.length > 0 ? 0 : -1;
  const sideways = key === 'ArrowLeft' || key === 'ArrowRight';
  const sign = key === 'ArrowLeft' || key === 'ArrowUp' ? -1 : 1;
  const from = points[current];
  let best = current;
  let best_cost = Infinity;
  points.forEach((point, i) => {
    const dx = point.x - from.x;
    const dy = point.y - from.y;
    const ahead = sign * (sideways ? dx || (i - current) * 1e-6 : dy);
    if (i === current || ahead <= 0) return;
    const cost = sideways ? ahead + 8 * Math.abs(dy) : ahead + 0.5 * Math.abs(dx);
    if (cost < best_cost) [best, best_cost] = [i, cost];
  });
  return best;
}

// Makes the marks of `svg` selectable. points: [{x, y, row, node}] in the plot's coordinates; the tooltip shows the
// values of `metrics`.
export function selectable(svg, data, points, metrics, detail) {
  let current = -1;
  const point_at = (index) => {
    if (current >= 0) points[current].node.classList.remove('chosen');
    current = index;
    points[current].node.classList.add('chosen');
    tips.show_tip(points[current].node, tip_of(data, points[current].row, metrics));
  };
  const choose = (index) => {
    fill(detail, detail_of(data, points[index].row, metrics));
    const id = data.trials.id[points[index].row];
    if (has_replay(data, id)) open_replay(id);
  };
  points.forEach((point, i) => {
    point.node.classList.add('clickable');
    point.node.addEventListener('pointerenter', () => point_at(i));
    point.node.addEventListener('pointerleave', tips.hide_tip);
    point.node.addEventListener('click', () => choose(i));
  });
  svg
    .attr('tabindex', 0)
    .attr('role', 'group')
    .on('blur', tips.hide_tip)
    .node()
    .addEventListener('keydown', (event) => {
      const {key} = event;
      if (key.startsWith('Arrow') && points.length > 0) {
        event.preventDefault();
        point_at(neighbour(points, current, key));
      } else if (key === 'Enter' && current >= 0) {
        choose(current);
      } else if (key === 'Escape') {
        tips.hide_tip();
      }
    });
}

export function detail_line() {
  return element('p', {class: 'detail', 'aria-live': 'polite'});
}

// Draws a trial's mark at (x, y): symbol and colour of its controller, or a cross if a robot did not arrive.
export function draw_mark(parent, data, row, x, y) {
  const combination = data.combinations[data.trials.combination[row]];
  const series = labels.series(data, 'local_controller', combination.local_controller);
  const failed = data.trials.outcome[row] !== 'succeeded';
  const path = failed ? plots.cross() : plots.symbol(series.symbol);
  return plots.add_mark(parent, x.toFixed(1), y.toFixed(1), {path, colour: series.colour, failed}).node();
}

// The legend of the marks.
export function mark_legend(data) {
  const values = labels.values_of(data, 'local_controller');
  const entries = values.map((value) => {
    const series = labels.series(data, 'local_controller', value);
    return {label: value, colour: series.colour, path: plots.symbol(series.symbol)};
  });
  if (data.trials.outcome.some((outcome) => !['succeeded', 'skipped', 'unsupported'].includes(outcome)))
    entries.push({label: 'not all robots arrived', colour: 'var(--ink)', path: plots.cross(), failed: true});
  return entries.length > 1 ? plots.legend(entries) : null;
}
