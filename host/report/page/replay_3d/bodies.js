// SPDX-License-Identifier: MIT
// bodies.js: the moving parts of the 3-D view: robots, people, plans and trails.
import * as look from '../replay/look.js';
import * as recording from '../replay/recording.js';
import {THREE} from './three.js';

export const ROBOT_HEIGHT_M = 0.35;
const BODY_HEIGHT_M = 1.4; // of people, below the head
const HEAD_M = 0.14;
export const PLAN = {
  width: 0.1,
  height: 0.02,
};
const TRAIL = {
  width: 0.14,
  height: 0.03,
};
const RING_HEIGHT_M = 0.04;
const LABEL_PX = 128;

// A flat band along points with two corners for each, so that any prefix of it can be drawn.
function ribbon(xs, ys, {width, height}) {
  const count = xs.length;
  const corners = new Float32Array(6 * count);
  const faces = [];
  let along = [1, 0];
  for (let i = 0; i < count; ++i) {
    const [before, after] = [Math.max(0, i - 1), Math.min(count - 1, i + 1)];
    const step = [xs[after] - xs[before], ys[after] - ys[before]];
    const length = Math.hypot(...step);
    if (length > 1e-6) along = [step[0] / length, step[1] / length];
    const side = [(-along[1] * width) / 2, (along[0] * width) / 2];
    corners.set([xs[i] + side[0], height, -(ys[i] + side[1]), xs[i] - side[0], height, -(ys[i] - side[1])], 6 * i);
    if (i > 0) faces.push(2 * i - 2, 2 * i - 1, 2 * i, 2 * i, 2 * i - 1, 2 * i + 1);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
  geometry.setIndex(faces);
  return geometry;
}

export function band(xs, ys, kind, colour, opacity) {
  const material = new THREE.MeshBasicMaterial({color: colour, transparent: true, opacity, side: THREE.DoubleSide});
  const mesh = new THREE.Mesh(ribbon(xs, ys, kind), material);
  mesh.frustumCulled = false;
  return mesh;
}

// A disc if `inner` is 0.
export function flat_ring(inner, outer, colour) {
  const flat = inner > 0 ? new THREE.RingBufferGeometry(inner, outer, 40) : new THREE.CircleBufferGeometry(outer, 24);
  const ring = new THREE.Mesh(flat, new THREE.MeshBasicMaterial({color: colour, side: THREE.DoubleSide}));
  ring.rotation.x = -Math.PI / 2;
  ring.position.y = RING_HEIGHT_M;
  return ring;
}

function number_label(text, colour) {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = LABEL_PX;
  const context = canvas.getContext('2d');
  context.beginPath();
  context.arc(LABEL_PX / 2, LABEL_PX / 2, LABEL_PX / 2 - 6, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
  context.lineWidth = 6;
  context.strokeStyle = look.text_on(colour);
  context.stroke();
  context.fillStyle = look.text_on(colour);
  context.font = `700 ${text.length > 2 ? 52 : 72}px system-ui, sans-serif`;
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(text, LABEL_PX / 2, LABEL_PX / 2 + 4);
  const label = new THREE.Sprite(
    new THREE.SpriteMaterial({map: new THREE.CanvasTexture(canvas), depthTest: false, sizeAttenuation: false})
  );
  label.renderOrder = 10;
  label.position.y = 1.1;
  return label;
}

function robot_solid(robot) {
  if (robot.parts.length === 0) {
    const disc = new THREE.CylinderBufferGeometry(robot.radius, robot.radius, ROBOT_HEIGHT_M, 28);
    disc.translate(0, ROBOT_HEIGHT_M / 2, 0);
    return disc;
  }
  const outlines = robot.parts.map((part) => new THREE.Shape(part.map(([x, y]) => new THREE.Vector2(x, y))));
  const solid = new THREE.ExtrudeBufferGeometry(outlines, {depth: ROBOT_HEIGHT_M, bevelEnabled: false});
  solid.rotateX(-Math.PI / 2);
  return solid;
}

// The wedge on top of the robot that shows its heading.
function heading_solid(robot) {
  const r = robot.radius;
  const arrow = new THREE.Shape(
    [
      [1.5 * r, 0],
      [0.1 * r, 0.6 * r],
      [0.1 * r, -0.6 * r],
    ].map(([x, y]) => new THREE.Vector2(x, y))
  );
  const solid = new THREE.ExtrudeBufferGeometry(arrow, {depth: 0.06, bevelEnabled: false});
  solid.rotateX(-Math.PI / 2);
  solid.translate(0, ROBOT_HEIGHT_M, 0);
  return solid;
}

export function make_robot(robot, colours) {
  const colour = look.robot_colour(colours, robot.index);
  const body = new THREE.Group();
  const base = new THREE.Mesh(robot_solid(robot), new THREE.MeshLambertMaterial({color: colour}));
  base.castShadow = true;
  const heading = new THREE.Mesh(heading_solid(robot), new THREE.MeshLambertMaterial({color: look.text_on(colour)}));
  const picked = flat_ring(robot.radius + 0.12, robot.radius + 0.24, colours.ink);
  const label = number_label(String(robot.index), colour);
  body.add(base, heading, picked, label);
  const goals = robot.goals.map((goal) => {
    const mark = new THREE.Group();
    mark.add(flat_ring(robot.radius, robot.radius + 0.1, colour), flat_ring(0, 0.1, colour));
    mark.position.set(goal.at[0], 0, -goal.at[1]);
    return mark;
  });
  const trail = band(robot.x, robot.y, TRAIL, colour, 0.85);
  return {body, base, picked, label, goals, trail, hits: make_hits(robot, colour), colour, plans: new Map()};
}

function make_hits(robot, colour) {
  const most = Math.max(0, ...(robot.scans || []).map((hits) => (hits ? hits.length : 0)));
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * most), 3));
  const points = new THREE.Points(geometry, new THREE.PointsMaterial({color: colour, size: 3, sizeAttenuation: false}));
  points.frustumCulled = false;
  return points;
}

export function place_hits(points, robot, at) {
  const places = points.geometry.attributes.position;
  const hits = recording.scan_hits(robot, at);
  hits.forEach(([x, y], i) => places.setXYZ(i, x, ROBOT_HEIGHT_M, -y));
  points.geometry.setDrawRange(0, hits.length);
  places.needsUpdate = true;
}

// Instanced meshes of bodies and heads; their number is the maximum of people at one time.
export function make_people(replay, colours) {
  const most = Math.max(1, replay.people.length);
  const material = new THREE.MeshLambertMaterial({color: colours.person});
  const trunk = new THREE.CylinderBufferGeometry(0.72, 1, 1, 16); // scaled to each person's radius
  trunk.translate(0, 0.5, 0);
  const meshes = [
    new THREE.InstancedMesh(trunk, material, most),
    new THREE.InstancedMesh(new THREE.SphereBufferGeometry(HEAD_M, 14, 10), material, most),
  ];
  for (const mesh of meshes) {
    mesh.castShadow = true;
    mesh.frustumCulled = false;
    mesh.count = 0;
  }
  return meshes;
}

export function place_people(meshes, replay, at, shown) {
  const [trunks, heads] = meshes;
  const matrix = new THREE.Matrix4();
  let count = 0;
  for (const person of shown ? replay.people : []) {
    const pose = recording.person_pose(person, at);
    if (!pose) continue;
    const width = 0.8 * person.radius;
    matrix.makeScale(width, BODY_HEIGHT_M, width).setPosition(pose.x, 0, -pose.y);
    trunks.setMatrixAt(count, matrix);
    matrix.makeTranslation(pose.x, BODY_HEIGHT_M + 0.8 * HEAD_M, -pose.y);
    heads.setMatrixAt(count, matrix);
    ++count;
  }
  for (const mesh of meshes) {
    mesh.count = count;
    mesh.instanceMatrix.needsUpdate = true;
  }
}
