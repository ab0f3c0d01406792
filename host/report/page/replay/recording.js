// SPDX-License-Identifier: MIT
// recording.js: unpacks a replay (format: host/report/replay/replay_data.hpp) to metres, radians and seconds.
import {unpacked_text} from '../packed_text.js';

export const ACTIVE = 0;
export const FINISHED = 1;
export const FAILED = 2;

// Decodes a list of differences in 1/1000.
function deltas(list, List = Float32Array) {
  const values = new List(list.length);
  let sum = 0;
  for (let i = 0; i < list.length; ++i) values[i] = (sum += list[i]) / 1000;
  return values;
}

// Decodes [sample, value, sample, value, ...] to a value for every sample.
function runs(list, count) {
  const values = new Int32Array(count);
  for (let i = 0; i < list.length; i += 2) values.fill(list[i + 1], list[i]);
  return values;
}

function points(flat) {
  const list = [];
  for (let i = 0; i < flat.length; i += 2) list.push([flat[i] / 1000, flat[i + 1] / 1000]);
  return list;
}

const point = (pair) => [pair[0] / 1000, pair[1] / 1000];

function shape(packed) {
  const common = {name: packed.name, height: packed.height / 1000};
  if (packed.vertices) return {...common, vertices: points(packed.vertices)};
  return {...common, center: point(packed.center), radius: packed.radius / 1000};
}

// The lidar's hits: for each sample a list of [x, y] in the robot's frame, or null without a new scan.
function scans(packed, count) {
  if (!packed) return null;
  const by_sample = new Array(count).fill(null);
  let sample = 0;
  packed.samples.forEach((difference, n) => {
    sample += difference;
    let range = 0;
    const hits = [];
    for (let beam = 0; beam < packed.beams; ++beam) {
      range += packed.ranges[n * packed.beams + beam];
      const angle = (packed.first + beam * packed.step) * 1e-6;
      if (range > 0) hits.push([(range / 100) * Math.cos(angle), (range / 100) * Math.sin(angle)]);
    }
    by_sample[sample] = hits;
  });
  return by_sample;
}

function robot(packed, index, count) {
  return {
    index,
    name: packed.name,
    radius: packed.radius / 1000,
    parts: (packed.parts || []).map(points), // convex polygons; none: a disc
    drive: packed.drive || 'differential',
    wheelbase: (packed.wheelbase || 0) / 1000, // of wheels that steer, else 0
    v_max: packed.v_max / 1000,
    goals: packed.goals.map((goal) => ({
      at: point(goal.at),
      theta: goal.theta === undefined ? null : goal.theta / 1000,
      tolerance: goal.tolerance / 1000,
    })),
    x: deltas(packed.x),
    y: deltas(packed.y),
    theta: deltas(packed.theta),
    state: runs(packed.state, count),
    goal: runs(packed.goal, count),
    speed: deltas(packed.speed),
    deviation: deltas(packed.deviation).map((value) => (value < 0 ? NaN : value)),
    scans: scans(packed.scans, count),
    routes: (packed.routes || []).map(({from, x, y}) => ({from, x: deltas(x || []), y: deltas(y || [])})),
    failure: packed.failure || '',
    culprit: packed.culprit ?? null,
    arrival: packed.arrival === undefined ? null : packed.arrival / 1000,
  };
}

function plan(packed) {
  return {
    revision: packed.revision,
    made: packed.made / 1000,
    from: packed.from / 1000,
    paths: packed.paths.map((path) => ({x: deltas(path.x), y: deltas(path.y), t: deltas(path.t)})),
  };
}

export function from_json(packed) {
  const count = packed.times.length;
  const times = deltas(packed.times, Float64Array);
  return {
    trial: packed.trial,
    times,
    end: times[count - 1] || 0,
    reason: packed.end ? packed.end.reason : 'the trace is incomplete',
    lower: point(packed.world.lower),
    upper: point(packed.world.upper),
    shapes: packed.world.shapes.map(shape),
    robots: packed.robots.map((one, index) => robot(one, index, count)),
    people: packed.people.map((one) => ({
      id: one.id,
      group: one.group,
      radius: one.radius / 1000,
      from: one.from,
      x: deltas(one.x),
      y: deltas(one.y),
    })),
    plans: packed.plans.map(plan),
    plan: runs(packed.plan, count),
    contacts: packed.contacts.map((one) => ({
      ...one,
      from: one.from / 1000,
      to: one.to / 1000,
      at: point(one.at),
      depth: one.depth / 1000,
      speed: one.speed === undefined ? undefined : one.speed / 1000,
    })),
    events: packed.events.map((one) => ({...one, from: one.from / 1000, to: one.to / 1000})),
  };
}

// Rejects if the browser cannot unpack it or the data are damaged.
export async function load(element) {
  return from_json(JSON.parse(await unpacked_text(element)));
}

const MARGIN_M = 3;

// The part of the world that contains the tracks and goals of the robots: [lower, upper].
export function active_box(replay) {
  const lower = [Infinity, Infinity];
  const upper = [-Infinity, -Infinity];
  const take = (axis, value) => {
    lower[axis] = Math.min(lower[axis], value);
    upper[axis] = Math.max(upper[axis], value);
  };
  for (const robot of replay.robots) {
    robot.x.forEach((x) => take(0, x));
    robot.y.forEach((y) => take(1, y));
    for (const goal of robot.goals) goal.at.forEach((value, axis) => take(axis, value));
  }
  if (replay.robots.length === 0) return [replay.lower, replay.upper];
  return [
    lower.map((value, axis) => Math.max(replay.lower[axis], value - MARGIN_M)),
    upper.map((value, axis) => Math.min(replay.upper[axis], value + MARGIN_M)),
  ];
}

// The sample at or before a time, and the fraction of the way to the next one.
export function moment(replay, t) {
  const times = replay.times;
  let k = Math.min(times.length - 1, Math.max(0, Math.floor(t * 10)));
  while (k > 0 && times[k] > t) --k;
  while (k + 1 < times.length && times[k + 1] <= t) ++k;
  const span = k + 1 < times.length ? times[k + 1] - times[k] : 0;
  return {t, k, fraction: span > 0 ? Math.min(1, Math.max(0, (t - times[k]) / span)) : 0};
}

function between(values, k, fraction) {
  const next = k + 1 < values.length ? values[k + 1] : values[k];
  return values[k] + (next - values[k]) * fraction;
}

// The hits of the newest scan of a robot, [x, y] in the world; none if it is older than a second.
export function scan_hits(one, at) {
  if (!one.scans) return [];
  for (let k = at.k; k >= 0 && k > at.k - 10; --k) {
    const hits = one.scans[k];
    if (!hits) continue;
    const [cos, sin] = [Math.cos(one.theta[k]), Math.sin(one.theta[k])];
    return hits.map(([x, y]) => [one.x[k] + cos * x - sin * y, one.y[k] + sin * x + cos * y]);
  }
  return [];
}

// Headings are unwrapped, so that they interpolate linearly.
export function robot_pose(one, at) {
  return {
    x: between(one.x, at.k, at.fraction),
    y: between(one.y, at.k, at.fraction),
    theta: between(one.theta, at.k, at.fraction),
  };
}

// The heading over some seconds: a robot that turns to and fro for a moment does not change it much.
export function mean_heading(one, at) {
  const [from, to] = [Math.max(0, at.k - 10), Math.min(one.theta.length - 1, at.k + 10)];
  let sum = 0;
  for (let k = from; k <= to; ++k) sum += one.theta[k];
  return sum / (to - from + 1);
}

// The angle of the front wheels of a robot with wheels that steer, from the curve that it drives; 0 where it stands.
export function steering_angle(one, at) {
  if (one.wheelbase === 0) return 0;
  const [a, b] = [Math.max(0, at.k - 1), Math.min(one.x.length - 1, at.k + 1)];
  const ahead = (one.x[b] - one.x[a]) * Math.cos(one.theta[at.k]) + (one.y[b] - one.y[a]) * Math.sin(one.theta[at.k]);
  if (Math.abs(ahead) < 0.01) return 0;
  return Math.atan((one.wheelbase * (one.theta[b] - one.theta[a])) / ahead);
}

// Null while the person is absent; `heading` is NaN for a standing person.
export function person_pose(one, at) {
  const k = at.k - one.from;
  if (k < 0 || k >= one.x.length) return null;
  const dx = one.x[Math.min(k + 1, one.x.length - 1)] - one.x[Math.max(k - 1, 0)];
  const dy = one.y[Math.min(k + 1, one.y.length - 1)] - one.y[Math.max(k - 1, 0)];
  return {
    x: between(one.x, k, at.fraction),
    y: between(one.y, k, at.fraction),
    heading: Math.hypot(dx, dy) > 0.02 ? Math.atan2(dy, dx) : NaN,
  };
}

export function current_path(replay, index, at) {
  const plan = replay.plans[replay.plan[at.k]];
  return plan ? plan.paths[index] : null;
}

// The local route that the robot was handed last; null while it follows its plan.
export function current_route(robot, at) {
  const route = robot.routes.findLast(({from}) => from <= at.k);
  return route && route.x.length > 0 && robot.state[at.k] === ACTIVE ? route : null;
}

// The planned position at time t.
export function planned_position(path, t) {
  const last = path.t.length - 1;
  if (last < 0) return null;
  let i = 0;
  while (i < last && path.t[i + 1] <= t) ++i;
  const span = i < last ? path.t[i + 1] - path.t[i] : 0;
  const fraction = span > 0 ? Math.min(1, Math.max(0, (t - path.t[i]) / span)) : 0;
  return [between(path.x, i, fraction), between(path.y, i, fraction)];
}
