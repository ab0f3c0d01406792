// SPDX-License-Identifier: MIT
// Reads traces by Foxglove's MCAP library and checks them against its message schemas. Called as:
//   traces.cjs FOLDER_OF_END_TO_END_TESTS, with the host in DMRP_HOST
'use strict';

const assert = require('node:assert/strict');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');

const Ajv = require('ajv').default;
const {McapIndexedReader, McapStreamReader} = require('@mcap/core');
const {loadDecompressHandlers} = require('@mcap/support');
const official = require('@foxglove/schemas/jsonschema');

const host = process.env.DMRP_HOST;
const endToEnd = process.argv[2];
const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'dmrp-traces-'));
process.on('exit', () => fs.rmSync(scratch, {recursive: true, force: true}));

const expectedSchemas = new Map([
  ['/map', 'foxglove.SceneUpdate'],
  ['/goals', 'foxglove.SceneUpdate'],
  ['/tf', 'foxglove.FrameTransforms'],
  ['/robots', 'foxglove.SceneUpdate'],
  ['/people', 'foxglove.SceneUpdate'],
  ['/plan', 'foxglove.SceneUpdate'],
  ['/contacts', 'foxglove.SceneUpdate'],
  ['/predictions', 'foxglove.SceneUpdate'],
  ['/log', 'foxglove.Log'],
  ['/metric_events', 'foxglove.Log'],
  ['/metric_events/robots', 'foxglove.SceneUpdate'],
  ['/robot_0/scan', 'foxglove.LaserScan'],
  ['/robot_1/scan', 'foxglove.LaserScan'],
]);

// The layout for Foxglove shows topics that traces have, and places each of its panels.
function checkLayout() {
  const layout = JSON.parse(fs.readFileSync(path.join(endToEnd, '../../docs/foxglove_layout.json'), 'utf8'));
  const placed = (node) => (typeof node === 'string' ? [node] : [...placed(node.first), ...placed(node.second)]);
  assert.deepEqual(placed(layout.layout).sort(), Object.keys(layout.configById).sort());
  const shown = Object.values(layout.configById).flatMap((panel) => [
    ...Object.keys(panel.topics || {}),
    ...(panel.topicToRender ? [panel.topicToRender] : []),
  ]);
  assert.ok(shown.length > 0);
  for (const topic of shown) assert.ok(expectedSchemas.has(topic), topic);
}

// Two planners, two controllers, two people; scans; the one that only follows its path runs into things.
function run() {
  const experiment = path.join(scratch, 'seen.toml');
  const text = fs.readFileSync(path.join(endToEnd, 'crossing.toml'), 'utf8');
  fs.writeFileSync(experiment, `${text}\n[record]\nscans = true\nannotations = true\n`);
  const directory = path.join(scratch, 'run');
  const options = {
    env: {...process.env, DMRP_SCENARIO_PATH: path.join(endToEnd, 'worlds')},
    stdio: ['ignore', 'inherit', 'inherit'],
  };
  execFileSync(host, ['run', experiment, '--quiet', '--trials', '1', '--out', directory], options);
  return directory;
}

function query(directory, sql) {
  const database = path.join(directory, 'results.sqlite');
  return JSON.parse(execFileSync('sqlite3', ['-json', database, sql], {encoding: 'utf8'}) || '[]');
}

function readable(bytes) {
  return {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  };
}

const seconds = (time) => time.sec + time.nsec * 1e-9;

// A schema without what does not bear on messages.
function essence(schema) {
  if (Array.isArray(schema)) return schema.map(essence);
  if (schema === null || typeof schema !== 'object') return schema;
  const kept = {};
  for (const key of Object.keys(schema).sort())
    if (key === 'properties')
      kept.properties = Object.fromEntries(
        Object.entries(schema.properties)
          .map(([name, property]) => [name, essence(property)])
          .sort()
      );
    else if (!['description', '$comment', 'required'].includes(key)) kept[key] = essence(schema[key]);
  return kept;
}

class Trace {
  static async open(file, decompressHandlers) {
    const trace = new Trace();
    trace.bytes = fs.readFileSync(file);
    trace.reader = await McapIndexedReader.Initialize({readable: readable(trace.bytes), decompressHandlers});
    trace.messages = new Map(); // by topic: {t, content}
    for await (const message of trace.reader.readMessages()) {
      const channel = trace.reader.channelsById.get(message.channelId);
      if (!trace.messages.has(channel.topic)) trace.messages.set(channel.topic, []);
      const content = channel.messageEncoding === 'json' ? JSON.parse(new TextDecoder().decode(message.data)) : null;
      trace.messages.get(channel.topic).push({t: Number(message.logTime) * 1e-9, content});
    }
    return trace;
  }
  on(topic) {
    return this.messages.get(topic) ?? [];
  }
}

function checkChannels(trace) {
  const topics = new Set();
  for (const channel of trace.reader.channelsById.values()) {
    topics.add(channel.topic);
    if (channel.topic === 'dmrp/trace') {
      assert.equal(channel.messageEncoding, 'dmrp');
      assert.equal(channel.metadata.get('version'), '4');
      continue;
    }
    const schema = trace.reader.schemasById.get(channel.schemaId);
    assert.equal(schema.name, expectedSchemas.get(channel.topic), channel.topic);
    assert.equal(schema.encoding, 'jsonschema');
    assert.equal(channel.messageEncoding, 'json');
    const ours = JSON.parse(new TextDecoder().decode(schema.data));
    const theirs = official[schema.name.replace('foxglove.', '')];
    assert.deepEqual(essence(ours), essence(theirs), `${schema.name} is not as Foxglove has it`);
  }
  for (const topic of expectedSchemas.keys()) assert.ok(topics.has(topic), `${topic} is missing`);
}

function checkMessages(trace) {
  const ajv = new Ajv({strict: false, validateFormats: false});
  for (const [topic, messages] of trace.messages) {
    if (topic === 'dmrp/trace') continue;
    const validate =
      ajv.getSchema(expectedSchemas.get(topic)) ??
      ajv.compile({$id: expectedSchemas.get(topic), ...official[expectedSchemas.get(topic).replace('foxglove.', '')]});
    for (const {t, content} of messages) {
      assert.ok(validate(content), `${topic} at ${t} s: ${ajv.errorsText(validate.errors)}`);
      for (const stamped of content.entities ?? content.transforms ?? [content])
        assert.ok(Math.abs(seconds(stamped.timestamp) - t) < 1e-9, `${topic}: stamped otherwise than logged`);
    }
  }
}

// In the order of the file, time runs on; what metrics found comes after the trial.
async function checkOrder(trace, decompressHandlers) {
  const reader = new McapStreamReader({decompressHandlers, validateCrcs: true});
  reader.append(trace.bytes);
  const topics = new Map();
  let last = 0n;
  let count = 0;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === 'Channel') topics.set(record.id, record.topic);
    if (record.type !== 'Message') continue;
    ++count;
    if (topics.get(record.channelId).startsWith('/metric_events')) continue;
    assert.ok(record.logTime >= last, `${topics.get(record.channelId)} goes back in time`);
    last = record.logTime;
  }
  assert.ok(reader.done());
  assert.equal(BigInt(count), trace.reader.statistics.messageCount);
}

function checkMotion(trace, directory, trial) {
  const frames = trace.on('/tf');
  const ticks = Math.floor(trial.sim_time_s / 0.1 + 1e-6) + 1;
  assert.ok(frames.length === ticks || frames.length === ticks + 1, `${frames.length} frames in ${trial.sim_time_s} s`);
  assert.ok(Math.abs(frames.at(-1).t - trial.sim_time_s) < 1e-6, 'the last state is missing');

  const goals = trace.on('/goals')[0].content.entities;
  const values = query(
    directory,
    `SELECT metric, subject, value FROM value WHERE trial_id = ${trial.id} AND
    subject_kind = 'robot' AND metric IN ('success', 'path_length') ORDER BY subject`
  );
  for (const [index, goal] of goals.entries()) {
    const poses = frames.map(({content}) => content.transforms[index]);
    for (const pose of poses) {
      assert.equal(pose.parent_frame_id, 'map');
      assert.equal(pose.child_frame_id, `robot_${index}`);
      assert.ok(Math.abs(Math.hypot(pose.rotation.z, pose.rotation.w) - 1) < 1e-3);
    }
    const value = (metric) => values.find((row) => row.metric === metric && row.subject === index).value;
    const at = poses.at(-1).translation;
    const to = goal.cylinders.at(-1).pose.position;
    const away = Math.hypot(at.x - to.x, at.y - to.y);
    assert.equal(away <= goal.cylinders.at(-1).size.x / 2 + 0.05, value('success') === 1, `${away} m from the goal`);
    let length = 0;
    for (let i = 1; i < poses.length; ++i)
      length += Math.hypot(
        poses[i].translation.x - poses[i - 1].translation.x,
        poses[i].translation.y - poses[i - 1].translation.y
      );
    assert.ok(
      Math.abs(length - value('path_length')) < 0.02 * length + 0.02,
      `${length} m, not ${value('path_length')}`
    );
  }
}

function checkScene(trace, trial) {
  const map = trace.on('/map')[0].content.entities;
  assert.deepEqual(
    map.map(({id}) => id),
    ['border', 'shape_0']
  );
  const pillar = map[1];
  assert.equal(pillar.metadata.find(({key}) => key === 'name').value, 'pillar');
  const points = pillar.triangles[0].points;
  assert.equal(Math.max(...points.map(({z}) => z)), 2);
  assert.deepEqual([Math.min(...points.map(({x}) => x)), Math.max(...points.map(({x}) => x))], [1.7, 2.3]);
  for (const index of pillar.triangles[0].indices) assert.ok(index < points.length);
  assert.equal(pillar.triangles[0].indices.length, 3 * (4 * 2 + 2)); // four sides and the top

  for (const {content} of trace.on('/people')) assert.equal(content.entities[0].cylinders.length, 2);
  assert.ok(trace.on('/people').length >= Math.floor(trial.sim_time_s / 0.1));
  const robots = trace.on('/robots');
  assert.ok(robots.length >= 1 && robots[0].t === 0);
  for (const {content} of robots)
    for (const [index, entity] of content.entities.entries())
      assert.ok(entity.frame_id === `robot_${index}` && entity.frame_locked && entity.cylinders[0].size.x === 0.5);
  const paths = trace.on('/plan')[0].content.entities;
  assert.equal(paths.length, 2);
  assert.deepEqual({...paths[0].lines[0].points[0], z: 0}, {x: 0.5, y: 2.5, z: 0});
}

// Hits of the first robot's scans lie in the world, and often on its border.
function checkScans(trace) {
  const poses = new Map(trace.on('/tf').map(({t, content}) => [Math.round(t * 1e3), content.transforms[0]]));
  let hits = 0;
  let border = 0;
  for (const {t, content} of trace.on('/robot_0/scan')) {
    assert.equal(content.ranges.length, 360);
    assert.equal(content.frame_id, 'robot_0');
    const {translation, rotation} = poses.get(Math.round(t * 1e3));
    const heading = 2 * Math.atan2(rotation.z, rotation.w);
    content.ranges.forEach((range, i) => {
      if (range === 0) return;
      const angle = heading + content.start_angle + (i * (content.end_angle - content.start_angle)) / 359;
      const [x, y] = [translation.x + range * Math.cos(angle), translation.y + range * Math.sin(angle)];
      const inside = Math.min(x, 8 - x, y, 6 - y);
      assert.ok(inside > -0.02, `a hit at (${x}, ${y})`);
      ++hits;
      if (inside < 0.02) ++border;
    });
  }
  assert.ok(trace.on('/robot_0/scan').length > 20 && hits > 5000 && border > 0.5 * hits, `${border} of ${hits}`);
}

function checkEvents(trace, directory, trial) {
  const events = query(
    directory,
    `SELECT metric, from_s, to_s, subjects, text FROM event WHERE trial_id = ${trial.id}`
  );
  const logs = trace.on('/metric_events');
  assert.equal(logs.length, events.length);
  const key = (metric, t) => `${metric} ${t.toFixed(6)}`;
  assert.deepEqual(
    logs.map(({t, content}) => key(content.name, t)).sort(),
    events.map(({metric, from_s}) => key(metric, from_s)).sort()
  );
  assert.equal(
    trace.on('/metric_events/robots').length,
    events.filter(({subjects}) => JSON.parse(subjects).length > 0).length
  );
  const contacts = trace.on('/log').filter(({content}) => content.name === 'contact');
  assert.equal(contacts.length, trace.on('/contacts').length);
  for (const {content} of trace.on('/contacts')) assert.deepEqual(content.entities[0].lifetime, {sec: 2, nsec: 0});
  const last = trace.on('/log').at(-1).content;
  assert.equal(last.name, 'trial');
  return {events: events.length, contacts: contacts.length};
}

// Cut short, it can be read up to the last whole chunk.
function checkCutShort(trace, decompressHandlers) {
  const reader = new McapStreamReader({decompressHandlers});
  reader.append(trace.bytes.subarray(0, Math.floor(trace.bytes.length * 0.9)));
  let count = 0;
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) count += record.type === 'Message';
  assert.ok(count > 100, `${count} messages before the cut`);
}

async function main() {
  checkLayout();
  const decompressHandlers = await loadDecompressHandlers();
  const directory = run();
  const found = {events: 0, contacts: 0};
  for (const trial of query(directory, 'SELECT id, sim_time_s FROM trial ORDER BY id')) {
    const file = path.join(directory, 'traces', `trial_${String(trial.id).padStart(6, '0')}.mcap`);
    const trace = await Trace.open(file, decompressHandlers);
    checkChannels(trace);
    checkMessages(trace);
    await checkOrder(trace, decompressHandlers);
    checkMotion(trace, directory, trial);
    checkScene(trace, trial);
    checkScans(trace);
    const {events, contacts} = checkEvents(trace, directory, trial);
    found.events += events;
    found.contacts += contacts;
    checkCutShort(trace, decompressHandlers);
    const counts = [...trace.messages].map(([topic, messages]) => `${topic} ${messages.length}`);
    console.log(`trial ${trial.id}: ${trace.bytes.length} bytes: ${counts.join(', ')}`);
  }
  assert.ok(found.events > 0 && found.contacts > 0, 'there should be events and contacts to look at');
}

main().catch((error) => {
  console.error(error);
  process.exitCode = 1;
});
