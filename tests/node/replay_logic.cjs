// SPDX-License-Identifier: MIT
// The calculations of the replay, without a browser: replay_logic.cjs PAGE_FOLDER.
'use strict';
const assert = require('node:assert');
const {page_modules} = require('./page_modules.cjs');

const {recording, events, map_view} = page_modules(process.argv[2], {
  recording: 'replay/recording.js',
  events: 'replay/events.js',
  map_view: 'replay/map_view.js',
});

const plain = (value) => JSON.parse(JSON.stringify(value));
const near = (found, expected, what = '') =>
  assert.ok(Math.abs(found - expected) < 1e-5, `${what}: ${found}, not ${expected}`);

// As report_data writes it: two robots, a person who comes late and leaves early, samples at 0, 0.1, 0.2 and 0.24 s.
function packed() {
  const robot = (index) => ({
    name: `r${index}`,
    radius: 250,
    v_max: 800,
    goals: [{at: [3000, 1000], theta: 1571, tolerance: 200}],
    x: [1000, 100, 100, 40],
    y: [500 + 1000 * index, 0, 0, 0],
    theta: [3100, 100, 100, 0],
    state: [0, 0, 3, 1],
    goal: [0, 0],
    speed: [0, 500, 300, 0],
    deviation: [-1, 1, 20, 0],
    arrival: 240,
  });
  return {
    format: 1,
    trial: 7,
    times: [0, 100, 100, 40],
    world: {
      lower: [0, 0],
      upper: [8000, 4000],
      shapes: [
        {name: 'box', height: 900, vertices: [1000, 0, 2000, 0, 2000, 500]},
        {name: 'post', height: 2500, center: [4000, 2000], radius: 300},
      ],
    },
    robots: [
      robot(0),
      {
        ...robot(1),
        arrival: undefined,
        failure: 'held behind another robot',
        culprit: 0,
        state: [0, 0, 2, 2],
        scans: {first: 0, step: 1570796, beams: 4, samples: [0, 2], ranges: [100, -100, 200, 0, 0, 0, 0, 300]},
      },
    ],
    people: [{id: 41, group: 2, radius: 300, from: 1, x: [2000, 100], y: [2000, 0]}],
    plans: [
      {
        revision: 1,
        made: 0,
        from: 0,
        paths: [
          {x: [1000, 1000, 0, 1000], y: [500, 0, 0, 0], t: [0, 1000, 2000, 1000]},
          {x: [], y: [], t: []},
        ],
      },
      {revision: 2, made: 100, from: 200, paths: []},
    ],
    plan: [0, 0],
    contacts: [
      {
        kind: 'robot',
        robot: 0,
        other: 1,
        from: 100,
        to: 200,
        at: [1500, 700],
        depth: 4,
        fault: 'both',
        speed: 420,
      },
      {
        kind: 'static',
        robot: 1,
        other: 2,
        from: 220,
        to: 220,
        at: [0, 0],
        depth: 1,
        fault: 'robot',
      },
    ],
    events: [
      {metric: 'blocking', from: 0, to: 200, robots: [0, 1], text: 'they block each other'},
      {metric: 'touches', from: 100, to: 200, robots: [0, 1], text: 'robot 0 and robot 1'},
      {metric: 'done', from: 200, to: 200, robots: [1, 0], text: 'robot 1 failed: held behind another robot'},
    ],
    end: {t: 240, reason: 'time limit'},
  };
}

const tests = {
  'a replay is decoded to metres, radians and seconds'() {
    const replay = recording.from_json(packed());
    near(replay.end, 0.24);
    near(replay.robots[1].y[3], 1.5);
    near(replay.robots[0].theta[2], 3.3, 'past pi');
    assert.deepStrictEqual(plain(replay.robots[0].state), {0: 0, 1: 0, 2: 0, 3: 1});
    assert.ok(Number.isNaN(replay.robots[0].deviation[0]));
    near(replay.robots[0].deviation[2], 0.02);
    assert.deepStrictEqual(plain(replay.shapes[0].vertices), [
      [1, 0],
      [2, 0],
      [2, 0.5],
    ]);
  },

  'a time lies between two samples, and at most at the last'() {
    const replay = recording.from_json(packed());
    const at = recording.moment(replay, 0.15);
    assert.strictEqual(at.k, 1);
    near(at.fraction, 0.5);
    near(recording.robot_pose(replay.robots[0], at).x, 1.15);
    assert.strictEqual(recording.moment(replay, 0.22).k, 2);
    near(recording.moment(replay, 0.22).fraction, 0.5, 'the last samples are nearer');
    assert.strictEqual(recording.moment(replay, 99).k, 3);
    assert.strictEqual(recording.moment(replay, 99).fraction, 0);
    assert.strictEqual(recording.moment(replay, 0).k, 0);
  },

  'a trial without a plan stands still, one without robots shows the world'() {
    const none = packed();
    Object.assign(none, {
      times: [0],
      people: [],
      plans: [],
      plan: [0, -1],
      contacts: [],
      events: [],
      end: {t: 0, reason: 'no plan'},
    });
    for (const robot of none.robots)
      Object.assign(robot, {
        x: [1000],
        y: [500],
        theta: [0],
        speed: [0],
        deviation: [-1],
        state: [0, 2],
        goal: [0, 0],
        arrival: undefined,
        failure: 'no plan',
        culprit: undefined,
        scans: undefined,
      });
    const replay = recording.from_json(none);
    assert.strictEqual(replay.end, 0);
    const at = recording.moment(replay, 0);
    assert.deepStrictEqual(plain(recording.robot_pose(replay.robots[0], at)), {x: 1, y: 0.5, theta: 0});
    assert.strictEqual(recording.current_path(replay, 0, at), null);
    assert.deepStrictEqual(plain(events.all_events(replay).map((event) => event.text)), [
      'robot 0 failed: no plan',
      'robot 1 failed: no plan',
    ]);
    const empty = recording.from_json({...none, robots: []});
    assert.deepStrictEqual(plain(recording.active_box(empty)), [
      [0, 0],
      [8, 4],
    ]);
  },

  'people are present from their first to their last sample'() {
    const replay = recording.from_json(packed());
    const person = (t) => recording.person_pose(replay.people[0], recording.moment(replay, t));
    assert.strictEqual(person(0.05), null);
    near(person(0.15).x, 2.05);
    near(person(0.15).heading, 0);
    near(person(0.2).x, 2.1);
    assert.strictEqual(person(0.24), null);
  },

  'the planned position waits where the plan does, and rests at its end'() {
    const path_of = recording.from_json(packed()).plans[0].paths[0];
    near(recording.planned_position(path_of, 0.5)[0], 1.5);
    near(recording.planned_position(path_of, 2)[0], 2);
    near(recording.planned_position(path_of, 3.5)[0], 2.5);
    near(recording.planned_position(path_of, 60)[0], 3);
    assert.strictEqual(recording.planned_position({x: [], y: [], t: []}, 1), null);
  },

  'hits of a scan are transformed to the world by the pose of the scan'() {
    const replay = recording.from_json(packed());
    const robot = replay.robots[1];
    const hits = recording.scan_hits(robot, recording.moment(replay, 0));
    assert.strictEqual(hits.length, 3); // 1, none, 2, 2 m at 0, 90, 180, 270 degrees
    near(hits[0][0], 1 + Math.cos(3.1), 'x');
    near(hits[0][1], 1.5 + Math.sin(3.1), 'y');
    near(Math.hypot(hits[2][0] - 1, hits[2][1] - 1.5), 2);
    assert.strictEqual(recording.scan_hits(robot, recording.moment(replay, 0.21)).length, 1);
    assert.strictEqual(recording.scan_hits(replay.robots[0], recording.moment(replay, 0)).length, 0);
  },

  'each event is listed once, in order'() {
    const found = events.all_events(recording.from_json(packed()));
    assert.deepStrictEqual(plain(found.map((event) => [event.from, event.kind, event.text])), [
      [0, 'metric', 'they block each other'],
      [0.1, 'plan', 'the planner returned no plan'],
      [0.1, 'contact', 'robot 0 and robot 1 touch at 0.42 m/s: both at fault'],
      [0.2, 'failure', 'robot 1 failed: held behind another robot, robot 0'],
      [0.22, 'contact', 'robot 1 and the border touch: robot 1 at fault'],
      [0.24, 'arrival', 'robot 0 arrived'],
    ]);
    assert.ok(events.is_now(found[0], 0.2) && !events.is_now(found[0], 0.21));
    assert.ok(events.is_now(found[2], 1.0), 'a contact is seen for a second');
  },

  'an event of a metric that resumes after a pause is one event'() {
    const replay = recording.from_json(packed());
    const block = (from, to, text = 'robots 6 and 7 block each other') => ({...replay.events[0], from, to, text});
    replay.events = [block(22.7, 25), block(26, 30.5), block(31, 42), block(24, 25, 'others'), block(50, 51)];
    const found = events.all_events(replay).filter((event) => event.kind === 'metric');
    assert.deepStrictEqual(plain(found.map((event) => [event.from, event.to])), [
      [22.7, 42],
      [24, 25],
      [50, 51],
    ]);
  },

  'the active part of the world contains tracks and goals, and lies inside the world'() {
    const [lower, upper] = recording.active_box(recording.from_json(packed()));
    assert.deepStrictEqual(plain([lower, upper]), [
      [0, 0],
      [6, 4],
    ]);
  },

  'wheels steer by the curve that the robot drives, and stand straight where it stands'() {
    const data = packed();
    data.robots[0] = {...data.robots[0], drive: 'ackermann', wheelbase: 500};
    data.robots[1].x = [1000, 0, 0, 0];
    Object.assign(data.robots[1], {drive: 'ackermann', wheelbase: 500});
    const replay = recording.from_json(data);
    // backwards: 0.2 m along +x with the heading 3.2 rad, 0.2 rad to the left
    near(
      recording.steering_angle(replay.robots[0], recording.moment(replay, 0.1)),
      Math.atan((0.5 * 0.2) / (0.2 * Math.cos(3.2)))
    );
    assert.strictEqual(recording.steering_angle(replay.robots[1], recording.moment(replay, 0.1)), 0);
    const discs = recording.from_json(packed());
    assert.strictEqual(recording.steering_angle(discs.robots[0], recording.moment(discs, 0.1)), 0);
    near(recording.mean_heading(replay.robots[0], recording.moment(replay, 0.1)), (3.1 + 3.2 + 3.3 + 3.3) / 4);
  },

  'zooming keeps the point under the pointer, and stops at the whole world'() {
    const view = map_view.make_map_view();
    view.width = 400;
    view.height = 300;
    view.show_world([0, 0], [40, 30]);
    const before = view.world(150, 120);
    view.zoom_by(2, 150, 120);
    const after = view.world(150, 120);
    near(after[0], before[0]);
    near(after[1], before[1]);
    near(view.x(after[0]), 150);
    near(view.y(after[1]), 120);
    view.zoom_by(1e-6);
    assert.strictEqual(view.zoom, 1);
    view.zoom_by(4);
    view.shift_by(1e9, -1e9);
    assert.ok(view.world(0, 0)[0] >= -1.5 && view.world(400, 300)[1] >= -1.5, 'the world stays in sight');
  },
};

for (const [name, test] of Object.entries(tests)) {
  test();
  console.log(`passed: ${name}`);
}
