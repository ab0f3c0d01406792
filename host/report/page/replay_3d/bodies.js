// SPDX-License-Identifier: MIT
// bodies.js: the moving parts of the 3-D view that belong to robots: bodies, labels, goals, plans, trails, lidar hits.
import * as look from '../replay/look.js';
import * as recording from '../replay/recording.js';
import {make_vehicle} from './vehicles.js';
import {THREE} from './three.js';

const LIDAR_HEIGHT_M = 0.3;
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
  label.position.y = 1.0;
  return label;
}

export function make_robot(robot, colours) {
  const colour = look.robot_colour(colours, robot.index);
  const body = new THREE.Group();
  const vehicle = make_vehicle(robot, colour);
  const picked = flat_ring(robot.radius + 0.12, robot.radius + 0.24, colours.ink);
  const label = number_label(String(robot.index), colour);
  body.add(vehicle.node, picked, label);
  const goals = robot.goals.map((goal) => {
    const mark = new THREE.Group();
    mark.add(flat_ring(robot.radius, robot.radius + 0.1, colour), flat_ring(0, 0.1, colour));
    mark.position.set(goal.at[0], 0, -goal.at[1]);
    return mark;
  });
  const trail = band(robot.x, robot.y, TRAIL, colour, 0.85);
  return {body, vehicle, picked, label, goals, trail, hits: make_hits(robot, colour), colour, plans: new Map()};
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
  hits.forEach(([x, y], i) => places.setXYZ(i, x, LIDAR_HEIGHT_M, -y));
  points.geometry.setDrawRange(0, hits.length);
  places.needsUpdate = true;
}
