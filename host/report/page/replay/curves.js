// SPDX-License-Identifier: MIT
// curves.js: speed and distance from the path of each robot over time, with a cursor at the replay's time.
import {axisBottom, axisLeft} from 'd3-axis';
import {scaleLinear} from 'd3-scale';
import {select} from 'd3-selection';
import {line} from 'd3-shape';

import {element} from '../elements.js';
import * as numbers from '../numbers.js';
import * as look from './look.js';
import {moment} from './recording.js';

const MARGIN = {
  top: 22,
  right: 16,
  bottom: 20,
  left: 36,
};
const HEIGHT_PX = 118;
const MANY_ROBOTS = 12;
const POINTS_A_PIXEL = 1;
const NEAR_PX = 14; // of the pointer to the line that it means

const KINDS = [
  {key: 'speed', title: 'Speed (m/s)', top: (replay) => Math.max(0.1, ...replay.robots.map((robot) => robot.v_max))},
  {
    key: 'deviation',
    title: 'Distance from the current path (m)',
    top: (replay) => Math.max(0.5, largest(replay, 'deviation')),
  },
];

function largest(replay, key) {
  let most = 0;
  for (const robot of replay.robots) for (const value of robot[key]) if (value > most) most = value;
  return most;
}

function smallest(replay, key) {
  let least = 0;
  for (const robot of replay.robots) for (const value of robot[key]) if (value < least) least = value;
  return least;
}

// Reduces `values` to at most `most` indices: of each block the value farthest from zero.
function thinned(values, most) {
  const every = Math.max(1, Math.ceil(values.length / most));
  const kept = [];
  for (let i = 0; i < values.length; i += every) {
    let best = i;
    for (let j = i; j < Math.min(values.length, i + every); ++j)
      if (Math.abs(values[j]) > Math.abs(values[best])) best = j;
    kept.push(best);
  }
  return kept;
}

// handlers: go(t), pick(robot index), point(robot index or null).
export function make_curves(handlers) {
  const node = element('div', {class: 'replay-curves'});
  const cursors = [];
  let replay = null;
  let events = [];
  let x = null;

  function draw_axes(svg, y, width) {
    svg
      .append('g')
      .attr('class', 'grid')
      .attr('transform', `translate(${MARGIN.left},0)`)
      .call(
        axisLeft(y)
          .ticks(3)
          .tickSize(-(width - MARGIN.left - MARGIN.right))
          .tickFormat('')
      )
      .select('.domain')
      .remove();
    svg
      .append('g')
      .attr('class', 'axis')
      .attr('transform', `translate(0,${HEIGHT_PX - MARGIN.bottom})`)
      .call(
        axisBottom(x)
          .ticks(Math.max(2, Math.floor(width / 90)))
          .tickSizeOuter(0)
          .tickFormat((t) => `${t} s`)
      );
    svg
      .append('g')
      .attr('class', 'axis')
      .attr('transform', `translate(${MARGIN.left},0)`)
      .call(axisLeft(y).ticks(3).tickSizeOuter(0))
      .select('.domain')
      .remove();
  }

  // The intervals of metric events.
  function draw_spans(svg) {
    svg
      .append('g')
      .selectAll('rect')
      .data(events.filter((event) => event.kind === 'metric' && event.to > event.from))
      .enter()
      .append('rect')
      .attr('class', 'replay-span')
      .attr('x', (event) => x(event.from))
      .attr('width', (event) => Math.max(1, x(event.to) - x(event.from)))
      .attr('y', MARGIN.top)
      .attr('height', HEIGHT_PX - MARGIN.top - MARGIN.bottom);
  }

  function draw_lines(svg, kind, y, width) {
    const robots = svg
      .append('g')
      .attr('class', `replay-lines${replay.robots.length > MANY_ROBOTS ? ' many' : ''}`)
      .selectAll('path')
      .data(replay.robots)
      .enter();
    const most = POINTS_A_PIXEL * width;
    robots
      .append('path')
      .attr('data-robot', (robot) => robot.index)
      .style('stroke', (robot) => look.robot_variable(robot.index))
      .attr('d', (robot) =>
        line()
          .defined((i) => Number.isFinite(robot[kind.key][i]))
          .x((i) => x(replay.times[i]))
          .y((i) => y(robot[kind.key][i]))(thinned(robot[kind.key], most))
      )
      .on('click', (robot) => handlers.pick(robot.index));
  }

  // The robot whose line is nearest to a place of the plot, or null.
  function robot_at(kind, y, px, py) {
    const {k} = moment(replay, x.invert(px));
    let best = null;
    let nearest = NEAR_PX;
    for (const robot of replay.robots) {
      const away = Math.abs(y(robot[kind.key][k]) - py); // NaN where it has no value
      if (away < nearest) [nearest, best] = [away, robot.index];
    }
    return best;
  }

  function follow_pointer(svg, kind, y) {
    let dragging = false;
    const plot = svg.node();
    const place = (event) => {
      const box = plot.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    const go = (event) => handlers.go(x.invert(place(event)[0]));
    const stop = () => {
      dragging = false;
    };
    plot.addEventListener('pointerdown', (event) => {
      dragging = true;
      plot.setPointerCapture(event.pointerId);
      go(event);
    });
    plot.addEventListener('pointermove', (event) => {
      if (dragging) go(event);
      else handlers.point(robot_at(kind, y, ...place(event)));
    });
    plot.addEventListener('pointerleave', () => handlers.point(null));
    plot.addEventListener('pointerup', stop);
    plot.addEventListener('pointercancel', stop);
  }

  function draw_plot(kind, width) {
    const bottom = kind.key === 'speed' ? smallest(replay, 'speed') : 0;
    const y = scaleLinear()
      .domain([bottom, kind.top(replay)])
      .nice(3)
      .range([HEIGHT_PX - MARGIN.bottom, MARGIN.top]);
    const svg = select(node)
      .append('svg')
      .attr('width', width)
      .attr('height', HEIGHT_PX)
      .attr('role', 'img')
      .attr('aria-label', `${kind.title} of each robot over time`);
    svg.append('text').attr('class', 'replay-plot-title').attr('x', 0).attr('y', 12).text(kind.title);
    const readout = svg.append('text').attr('class', 'soft').attr('x', width).attr('y', 12).attr('text-anchor', 'end');
    draw_axes(svg, y, width);
    draw_spans(svg);
    draw_lines(svg, kind, y, width);
    const cursor = svg.append('g').attr('class', 'replay-cursor');
    cursor
      .append('line')
      .attr('y1', MARGIN.top - 4)
      .attr('y2', HEIGHT_PX - MARGIN.bottom);
    const dot = cursor.append('circle').attr('r', 4).style('display', 'none');
    cursors.push({cursor, dot, readout, y, key: kind.key});
    follow_pointer(svg, kind, y);
  }

  function resize() {
    if (!replay) return;
    const width = Math.max(200, node.clientWidth);
    node.textContent = '';
    cursors.length = 0;
    x = scaleLinear()
      .domain([0, replay.end || 1])
      .range([MARGIN.left, width - MARGIN.right]);
    for (const kind of KINDS) draw_plot(kind, width);
  }

  function show(shown, its_events) {
    replay = shown;
    events = its_events;
    resize();
  }

  // Shows the value of the robot at the pointer, else of the picked one.
  function draw(at, picked, hovered) {
    const shown = hovered === null ? picked : hovered;
    for (const {cursor, dot, readout, y, key} of cursors) {
      cursor.attr('transform', `translate(${x(at.t)},0)`);
      const value = shown === null ? NaN : replay.robots[shown][key][at.k];
      dot.style('display', Number.isFinite(value) ? null : 'none');
      if (Number.isFinite(value)) dot.attr('cy', y(value)).style('fill', look.robot_variable(shown));
      const words = Number.isFinite(value) ? `: ${numbers.fixed(value, 2)}` : '';
      readout.text(shown === null ? '' : `robot ${shown}${words}`);
    }
  }

  function mark({picked, hovered}) {
    const is_marked = (robot) => robot.index === picked || robot.index === hovered;
    select(node)
      .selectAll('.replay-lines')
      .classed('some-marked', picked !== null || hovered !== null)
      .selectAll('path')
      .classed('marked', is_marked)
      .filter(is_marked)
      .raise();
  }

  return {node, show, draw, resize, mark};
}
