// SPDX-License-Identifier: MIT
// events.js: the events of a trial in order: contacts, metric events, arrivals, failures, new plans.
import {FAILED} from './recording.js';

const SAME_S = {
  contact: 0.05,
  arrival: 0.15,
  failure: 0.15,
}; // states are sampled every 0.1 s

function other_body(replay, contact) {
  if (contact.kind === 'robot') return `robot ${contact.other}`;
  if (contact.kind === 'person') return `person ${contact.other}`;
  const shape = replay.shapes[contact.other];
  return shape ? shape.name || 'an obstacle' : 'the border';
}

function fault_words(contact) {
  return {
    none: 'neither at fault',
    both: 'both at fault',
    robot: `robot ${contact.robot} at fault`,
    other: `${contact.kind} ${contact.other} at fault`,
  }[contact.fault];
}

function contact_event(replay, contact) {
  const speed = contact.speed === undefined ? '' : ` at ${contact.speed.toFixed(2)} m/s`;
  return {
    kind: 'contact',
    lane: 'contacts',
    from: contact.from,
    to: contact.to,
    robots: contact.kind === 'robot' ? [contact.robot, contact.other] : [contact.robot],
    at: contact.at,
    text: `robot ${contact.robot} and ${other_body(replay, contact)} touch${speed}: ${fault_words(contact)}`,
  };
}

function failure_time(replay, robot) {
  const k = robot.state.indexOf(FAILED);
  return k < 0 ? replay.end : replay.times[k];
}

function robot_events(replay) {
  const list = [];
  for (const robot of replay.robots) {
    if (robot.arrival !== null)
      list.push({kind: 'arrival', t: robot.arrival, robot, text: `robot ${robot.index} arrived`});
    else if (robot.failure)
      list.push({
        kind: 'failure',
        t: failure_time(replay, robot),
        robot,
        text: `robot ${robot.index} failed: ${robot.failure}${robot.culprit === null ? '' : `, robot ${robot.culprit}`}`,
      });
  }
  return list.map(({kind, t, robot, text}) => ({
    kind,
    lane: 'robots',
    from: t,
    to: t,
    robots: robot.culprit === null ? [robot.index] : [robot.index, robot.culprit],
    at: null,
    text,
  }));
}

function plan_events(replay) {
  return replay.plans
    .filter((plan, i) => i > 0 || plan.paths.length === 0)
    .map((plan) => ({
      kind: 'plan',
      lane: 'plans',
      from: plan.made,
      to: plan.made,
      robots: [],
      at: null,
      text: plan.paths.length > 0 ? `new plan, valid from ${plan.from.toFixed(1)} s` : 'the planner returned no plan',
    }));
}

// Whether a metric event repeats an event of the trace: same robots, same time.
function is_known(event, known) {
  const same_robots = (other) =>
    other.robots.length === event.robots.length && other.robots.every((robot) => event.robots.includes(robot));
  return known.some(
    (other) =>
      other.robots.length > 0 &&
      same_robots(other) &&
      Math.abs(other.from - event.from) < SAME_S[other.kind] &&
      Math.abs(other.to - event.to) < SAME_S[other.kind]
  );
}

const PAUSE_S = 3; // a metric's event that resumes sooner is the same event

// Joins events of the same metric with the same text that follow one another closely.
function joined(events) {
  const found = [];
  for (const event of [...events].sort((a, b) => a.from - b.from)) {
    const before = found.find(
      (one) => one.lane === event.lane && one.text === event.text && event.from - one.to <= PAUSE_S
    );
    if (before) before.to = Math.max(before.to, event.to);
    else found.push(event);
  }
  return found;
}

// lane: the row of the time line.
export function all_events(replay) {
  const known = [
    ...replay.contacts.map((contact) => contact_event(replay, contact)),
    ...robot_events(replay),
    ...plan_events(replay),
  ];
  const metric_events = replay.events.map((event) => ({
    kind: 'metric',
    lane: event.metric,
    from: event.from,
    to: event.to,
    robots: event.robots,
    at: null,
    text: event.text,
  }));
  return [...known, ...joined(metric_events.filter((event) => !is_known(event, known)))].sort(
    (a, b) => a.from - b.from || a.to - b.to
  );
}

// Whether the event is at this time. A contact counts for at least a second.
export function is_now(event, t) {
  return t >= event.from - 1e-6 && t <= Math.max(event.to, event.from + (event.kind === 'contact' ? 1 : 0)) + 1e-6;
}
