// SPDX-License-Identifier: MIT
// map.js: the flat map of a replay on a canvas. Static shapes are drawn once to a second canvas, the rest every frame.
import {is_now} from './events.js';
import * as look from './look.js';
import * as recording from './recording.js';
import {make_map_view} from './map_view.js';

const MANY_ROBOTS = 12; // above this, only marked robots show their whole plan and trail
const SHORT_TRAIL = 100; // samples
const CONTACT_SEEN_S = 1.0;
const TOGETHER_M = 4; // members of a group closer than this are joined by a line

function trace_line(context, view, xs, ys, from, to) {
  context.beginPath();
  for (let i = from; i < to; ++i) {
    if (i === from) context.moveTo(view.x(xs[i]), view.y(ys[i]));
    else context.lineTo(view.x(xs[i]), view.y(ys[i]));
  }
}

function circle(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
}

function trace_shape(context, view, shape) {
  if (shape.vertices) {
    context.beginPath();
    shape.vertices.forEach(([x, y], i) =>
      i === 0 ? context.moveTo(view.x(x), view.y(y)) : context.lineTo(view.x(x), view.y(y))
    );
    context.closePath();
  } else {
    circle(context, view.x(shape.center[0]), view.y(shape.center[1]), shape.radius * view.scale());
  }
}

function holds(shape, x, y) {
  if (!shape.vertices) return Math.hypot(x - shape.center[0], y - shape.center[1]) <= shape.radius;
  return shape.vertices.every(([ax, ay], i) => {
    const [bx, by] = shape.vertices[(i + 1) % shape.vertices.length];
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0; // convex, counter-clockwise
  });
}

// A round length whose bar is at most 100 px long.
function scale_bar_m(scale) {
  return [50, 20, 10, 5, 2, 1, 0.5, 0.2].find((length) => length * scale <= 100) || 0.1;
}

function draw_scale_bar(context, view, colours) {
  const length = scale_bar_m(view.scale());
  const x = 14;
  const y = view.height - 14;
  const right = x + length * view.scale();
  context.font = '11px system-ui, sans-serif';
  context.textAlign = 'left';
  context.textBaseline = 'alphabetic';
  context.lineJoin = 'round';
  context.fillStyle = colours.ink;
  for (const [colour, width] of [
    [colours.floor, 5],
    [colours.ink, 1.5],
  ]) {
    // a halo first
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    context.moveTo(x, y - 4);
    context.lineTo(x, y);
    context.lineTo(right, y);
    context.lineTo(right, y - 4);
    context.stroke();
    if (width > 2) context.strokeText(`${length} m`, right + 6, y + 1);
  }
  context.fillText(`${length} m`, right + 6, y + 1);
}

function draw_static(context, view, replay, colours) {
  context.fillStyle = colours.surface;
  context.fillRect(0, 0, view.width, view.height);
  const left = view.x(replay.lower[0]);
  const top = view.y(replay.upper[1]);
  const width = view.x(replay.upper[0]) - left;
  const height = view.y(replay.lower[1]) - top;
  context.fillStyle = colours.floor;
  context.fillRect(left, top, width, height);
  context.lineJoin = 'round';
  for (const shape of replay.shapes) {
    const wall = look.is_wall(shape);
    trace_shape(context, view, shape);
    context.fillStyle = wall ? colours.wall : colours.furniture;
    context.fill();
    context.strokeStyle = wall ? colours.wall : colours.edge;
    context.lineWidth = 0.75;
    context.stroke();
  }
  context.strokeStyle = colours.wall;
  context.lineWidth = 2;
  context.strokeRect(left, top, width, height);
}

function draw_scan(context, view, robot, at, colour) {
  context.fillStyle = colour;
  for (const [x, y] of recording.scan_hits(robot, at)) context.fillRect(view.x(x) - 1.25, view.y(y) - 1.25, 2.5, 2.5);
}

function draw_goal(context, view, robot, goal, colour, strong) {
  const x = view.x(goal.at[0]);
  const y = view.y(goal.at[1]);
  const radius = Math.max(6, robot.radius * view.scale());
  circle(context, x, y, radius);
  context.strokeStyle = colour;
  context.lineWidth = strong ? 2.5 : 1.5;
  context.stroke();
  circle(context, x, y, radius * 0.35);
  context.fillStyle = colour;
  context.fill();
  if (goal.theta === null) return;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + 1.6 * radius * Math.cos(goal.theta), y - 1.6 * radius * Math.sin(goal.theta));
  context.stroke();
}

function draw_plan(context, view, path, colour, strong) {
  trace_line(context, view, path.x, path.y, 0, path.x.length);
  context.setLineDash([2, 5]);
  context.lineCap = 'round';
  context.strokeStyle = colour;
  context.lineWidth = strong ? 3 : 2;
  context.globalAlpha = strong ? 1 : 0.75;
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function draw_route(context, view, route, colour) {
  trace_line(context, view, route.x, route.y, 0, route.x.length);
  context.strokeStyle = colour;
  context.lineWidth = 1.25;
  context.globalAlpha = 0.8;
  context.stroke();
  context.globalAlpha = 1;
}

function draw_planned_position(context, view, path, t, colour) {
  const position = recording.planned_position(path, t);
  if (!position) return;
  circle(context, view.x(position[0]), view.y(position[1]), 4.5);
  context.strokeStyle = colour;
  context.lineWidth = 1.75;
  context.stroke();
}

function draw_trail(context, view, robot, pose, at, colour, strong, whole) {
  const from = whole ? 0 : Math.max(0, at.k - SHORT_TRAIL);
  trace_line(context, view, robot.x, robot.y, from, at.k + 1);
  context.lineTo(view.x(pose.x), view.y(pose.y));
  context.lineCap = 'butt';
  context.strokeStyle = colour;
  context.lineWidth = strong ? 3 : 2;
  context.globalAlpha = strong ? 0.95 : 0.6;
  context.stroke();
  context.globalAlpha = 1;
}

function draw_all_of_trail(context, view, robot, colour) {
  trace_line(context, view, robot.x, robot.y, 0, robot.x.length);
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.stroke();
}

function draw_person(context, view, person, pose, colours) {
  const x = view.x(pose.x);
  const y = view.y(pose.y);
  const radius = Math.max(3, person.radius * view.scale());
  circle(context, x, y, radius);
  context.fillStyle = colours.person;
  context.fill();
  context.strokeStyle = colours.floor;
  context.lineWidth = 1;
  context.stroke();
  if (Number.isNaN(pose.heading)) return;
  context.beginPath();
  context.moveTo(x + 0.35 * radius * Math.cos(pose.heading), y - 0.35 * radius * Math.sin(pose.heading));
  context.lineTo(x + 1.4 * radius * Math.cos(pose.heading), y - 1.4 * radius * Math.sin(pose.heading));
  context.strokeStyle = colours.person;
  context.lineWidth = 2;
  context.stroke();
}

function draw_people(context, view, replay, at, colours) {
  const groups = new Map();
  const there = [];
  for (const person of replay.people) {
    const pose = recording.person_pose(person, at);
    if (!pose) continue;
    there.push([person, pose]);
    if (person.group === 0) continue;
    if (!groups.has(person.group)) groups.set(person.group, []);
    groups.get(person.group).push(pose);
  }
  context.strokeStyle = colours.person;
  context.lineWidth = Math.max(2, 0.12 * view.scale());
  context.lineCap = 'round';
  context.globalAlpha = 0.4;
  for (const group of groups.values()) {
    context.beginPath();
    for (let i = 1; i < group.length; ++i) {
      if (Math.hypot(group[i].x - group[i - 1].x, group[i].y - group[i - 1].y) > TOGETHER_M) continue;
      context.moveTo(view.x(group[i - 1].x), view.y(group[i - 1].y));
      context.lineTo(view.x(group[i].x), view.y(group[i].y));
    }
    context.stroke();
  }
  context.globalAlpha = 1;
  for (const [person, pose] of there) draw_person(context, view, person, pose, colours);
}

function trace_robot(context, robot, radius, scale) {
  if (robot.parts.length === 0) {
    circle(context, 0, 0, radius);
    return;
  }
  context.beginPath();
  for (const part of robot.parts) {
    part.forEach(([x, y], i) =>
      i === 0 ? context.moveTo(x * scale, -y * scale) : context.lineTo(x * scale, -y * scale)
    );
    context.closePath();
  }
}

function draw_robot(context, view, robot, pose, state, colours, picked) {
  const colour = look.robot_colour(colours, robot.index);
  const scale = Math.max(view.scale(), 6.5 / robot.radius); // at least 6.5 px radius
  const radius = robot.radius * scale;
  context.save();
  context.translate(view.x(pose.x), view.y(pose.y));
  context.save();
  context.rotate(-pose.theta);
  if (picked) {
    circle(context, 0, 0, radius + 5);
    context.strokeStyle = colours.ink;
    context.lineWidth = 2;
    context.stroke();
  }
  // heading
  context.beginPath();
  context.moveTo(radius * 1.75, 0);
  context.lineTo(radius * 0.75, radius * 0.62);
  context.lineTo(radius * 0.75, -radius * 0.62);
  context.closePath();
  context.fillStyle = colour;
  context.fill();
  trace_robot(context, robot, radius, scale);
  context.fillStyle = state === recording.FAILED ? colours.floor : colour;
  context.fill();
  context.strokeStyle = state === recording.FAILED ? colour : colours.floor;
  context.lineWidth = state === recording.FAILED ? 2.5 : 1.25;
  context.stroke();
  context.restore();
  context.font = `700 ${Math.max(8, Math.min(13, radius * 1.25))}px system-ui, sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillStyle = state === recording.FAILED ? colours.ink : look.text_on(colour);
  context.fillText(String(robot.index), 0, 0.5);
  context.restore();
}

// Joins the robots of current metric events by a band.
function draw_relations(context, view, scene, poses) {
  for (const event of scene.events) {
    if (event.kind !== 'metric' || event.robots.length < 2 || !is_now(event, scene.at.t)) continue;
    context.beginPath();
    event.robots.forEach((index, i) => {
      const pose = poses[index];
      if (pose)
        i === 0 ? context.moveTo(view.x(pose.x), view.y(pose.y)) : context.lineTo(view.x(pose.x), view.y(pose.y));
    });
    context.strokeStyle = scene.colours.warning;
    context.lineWidth = Math.max(6, 0.3 * view.scale());
    context.lineCap = 'round';
    context.globalAlpha = 0.35;
    context.stroke();
    context.globalAlpha = 1;
  }
}

function draw_contacts(context, view, scene) {
  context.strokeStyle = scene.colours.bad;
  context.lineCap = 'butt';
  for (const contact of scene.replay.contacts) {
    if (contact.from > scene.at.t + 1e-6) break;
    const now = scene.at.t <= Math.max(contact.to, contact.from + CONTACT_SEEN_S);
    const x = view.x(contact.at[0]);
    const y = view.y(contact.at[1]);
    const arm = 3.5;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x - arm, y - arm);
    context.lineTo(x + arm, y + arm);
    context.moveTo(x - arm, y + arm);
    context.lineTo(x + arm, y - arm);
    context.stroke();
    if (!now) continue;
    circle(context, x, y, Math.max(16, 0.9 * view.scale()));
    context.lineWidth = 3;
    context.stroke();
  }
}

// Draws what moves. `scene`: {replay, at, picked, hovered, layers, events, colours}.
function draw_moving(context, view, scene) {
  const {replay, at, picked, hovered, layers, colours} = scene;
  const is_marked = (robot) => robot.index === picked || robot.index === hovered;
  const few = replay.robots.length <= MANY_ROBOTS;
  const poses = replay.robots.map((robot) => recording.robot_pose(robot, at));
  const ordered = [...replay.robots.filter((robot) => !is_marked(robot)), ...replay.robots.filter(is_marked)];
  const colour = (robot) => look.robot_colour(colours, robot.index);

  for (const robot of ordered) {
    const strong = is_marked(robot);
    const path = recording.current_path(replay, robot.index, at);
    if (few || strong)
      draw_goal(
        context,
        view,
        robot,
        robot.goals[Math.min(robot.goal[at.k], robot.goals.length - 1)],
        colour(robot),
        strong
      );
    if (layers.plans && path && (few || strong)) draw_plan(context, view, path, colour(robot), strong);
    const route = recording.current_route(robot, at);
    if (layers.plans && route && (few || strong)) draw_route(context, view, route, colour(robot));
    if (scene.whole_trails) draw_all_of_trail(context, view, robot, colour(robot));
    else if (layers.trails)
      draw_trail(context, view, robot, poses[robot.index], at, colour(robot), strong, few || strong);
  }
  if (layers.scans)
    for (const robot of picked === null ? replay.robots : [replay.robots[picked]])
      draw_scan(context, view, robot, at, colour(robot));
  if (layers.people) draw_people(context, view, replay, at, colours);
  draw_relations(context, view, scene, poses);
  for (const robot of ordered) {
    const path = recording.current_path(replay, robot.index, at);
    if (layers.plans && path && robot.state[at.k] === recording.ACTIVE && (few || is_marked(robot)))
      draw_planned_position(context, view, path, at.t, colour(robot));
    draw_robot(context, view, robot, poses[robot.index], robot.state[at.k], colours, robot.index === picked);
  }
  draw_contacts(context, view, scene);
}

export function make_map(canvas) {
  const view = make_map_view();
  const still = document.createElement('canvas');
  const context = canvas.getContext('2d');
  let still_is = ''; // state that the static canvas shows
  let ratio = 1;

  function resize() {
    ratio = Math.min(2, window.devicePixelRatio || 1);
    view.width = canvas.clientWidth;
    view.height = canvas.clientHeight;
    for (const one of [canvas, still]) {
      one.width = Math.max(1, Math.round(view.width * ratio));
      one.height = Math.max(1, Math.round(view.height * ratio));
    }
    view.look_at(view.center);
    still_is = '';
  }

  function redraw_still(scene) {
    const wanted = [scene.replay.trial, view.zoom, view.center, scene.colours.dark].join();
    if (wanted === still_is) return;
    still_is = wanted;
    const paper = still.getContext('2d');
    paper.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw_static(paper, view, scene.replay, scene.colours);
  }

  function draw(scene) {
    if (scene.follow && scene.picked !== null) {
      const pose = recording.robot_pose(scene.replay.robots[scene.picked], scene.at);
      view.look_at([pose.x, pose.y]);
    }
    redraw_still(scene);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(still, 0, 0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw_moving(context, view, scene);
    draw_scale_bar(context, view, scene.colours);
  }

  // The robot at a pixel of the canvas, or null.
  function robot_at(scene, px, py) {
    let best = null;
    let nearest = Infinity;
    for (const robot of scene.replay.robots) {
      const pose = recording.robot_pose(robot, scene.at);
      const distance = Math.hypot(view.x(pose.x) - px, view.y(pose.y) - py);
      if (distance < nearest && distance <= Math.max(16, robot.radius * view.scale() + 4)) {
        nearest = distance;
        best = robot.index;
      }
    }
    return best;
  }

  // A description of the object at a pixel; "" for the floor.
  function words_at(scene, px, py) {
    const index = robot_at(scene, px, py);
    if (index !== null) return `robot ${index}: ${scene.replay.robots[index].name}`;
    const [x, y] = view.world(px, py);
    for (const person of scene.replay.people) {
      const pose = recording.person_pose(person, scene.at);
      if (pose && Math.hypot(pose.x - x, pose.y - y) <= person.radius + 0.1)
        return `person ${person.id}${person.group ? `, of group ${person.group}` : ''}`;
    }
    const shape = scene.replay.shapes.find((one) => holds(one, x, y));
    return shape ? `${shape.name || 'obstacle'}, ${shape.height} m high` : '';
  }

  return {
    view,
    resize,
    draw,
    robot_at,
    words_at,
    forget: () => {
      still_is = '';
    },
  };
}
