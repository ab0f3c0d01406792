// SPDX-License-Identifier: MIT
// world.js: the static parts of the 3-D view: floor, walls, furniture, light.
// The world's (x, y, height) is three.js's (x, height, -y).
import * as look from '../replay/look.js';
import {THREE} from './three.js';

const SHADOW_PX = 2048;
const CIRCLE_PARTS = 32;
const SOLID_M = 1.1; // walls are translucent above this height
const GLASS = 0.16;

// The part of a shape between two heights.
function slice(shape, from, to) {
  let solid = null;
  if (shape.vertices) {
    const outline = new THREE.Shape(shape.vertices.map(([x, y]) => new THREE.Vector2(x, y)));
    solid = new THREE.ExtrudeBufferGeometry(outline, {depth: to - from, bevelEnabled: false});
    solid.rotateX(-Math.PI / 2);
    solid.translate(0, from, 0);
  } else {
    solid = new THREE.CylinderBufferGeometry(shape.radius, shape.radius, to - from, CIRCLE_PARTS);
    solid.translate(shape.center[0], (from + to) / 2, -shape.center[1]);
  }
  return solid;
}

// Lower shapes are lighter, which distinguishes tables from shelves.
function shape_colour(shape, colours) {
  if (look.is_wall(shape)) return new THREE.Color(colours.wall);
  return new THREE.Color(colours.furniture).lerp(new THREE.Color(colours.edge), Math.min(1, shape.height / 2));
}

function make_floor(replay, colours) {
  const width = replay.upper[0] - replay.lower[0];
  const depth = replay.upper[1] - replay.lower[1];
  const floor = new THREE.Mesh(
    new THREE.PlaneBufferGeometry(width, depth),
    new THREE.MeshLambertMaterial({color: colours.floor})
  );
  floor.rotation.x = -Math.PI / 2;
  floor.position.set((replay.lower[0] + replay.upper[0]) / 2, 0, -(replay.lower[1] + replay.upper[1]) / 2);
  floor.receiveShadow = true;
  return floor;
}

function make_shapes(replay, colours) {
  const group = new THREE.Group();
  const line = new THREE.LineBasicMaterial({
    color: colours.dark ? '#000000' : '#30343a',
    transparent: true,
    opacity: colours.dark ? 0.5 : 0.28,
  });
  for (const shape of replay.shapes) {
    const colour = shape_colour(shape, colours);
    const solid_m = look.is_wall(shape) ? SOLID_M : shape.height;
    const solid = new THREE.Mesh(slice(shape, 0, solid_m), new THREE.MeshLambertMaterial({color: colour}));
    solid.castShadow = solid.receiveShadow = true;
    group.add(solid, new THREE.LineSegments(new THREE.EdgesGeometry(slice(shape, 0, shape.height), 30), line));
    if (solid_m < shape.height) {
      const glass = new THREE.MeshLambertMaterial({
        color: colour,
        transparent: true,
        opacity: GLASS,
        depthWrite: false,
      });
      group.add(new THREE.Mesh(slice(shape, solid_m, shape.height), glass));
    }
  }
  return group;
}

function make_border(replay, colours) {
  const [[left, bottom], [right, top]] = [replay.lower, replay.upper];
  const corners = [
    [left, bottom],
    [right, bottom],
    [right, top],
    [left, top],
    [left, bottom],
  ].map(([x, y]) => new THREE.Vector3(x, 0.02, -y));
  return new THREE.Line(
    new THREE.BufferGeometry().setFromPoints(corners),
    new THREE.LineBasicMaterial({color: colours.wall})
  );
}

function make_light(replay, colours) {
  const group = new THREE.Group();
  const width = replay.upper[0] - replay.lower[0];
  const depth = replay.upper[1] - replay.lower[1];
  const middle = [(replay.lower[0] + replay.upper[0]) / 2, (replay.lower[1] + replay.upper[1]) / 2];
  const reach = Math.hypot(width, depth) / 2 + 1;
  const sun = new THREE.DirectionalLight('#ffffff', colours.dark ? 0.6 : 0.45);
  sun.position.set(middle[0] - 0.45 * reach, 1.6 * reach, -middle[1] + 0.75 * reach);
  sun.target.position.set(middle[0], 0, -middle[1]);
  sun.castShadow = true;
  sun.shadow.mapSize.set(SHADOW_PX, SHADOW_PX);
  sun.shadow.bias = -0.0008;
  Object.assign(sun.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 4 * reach});
  group.add(
    new THREE.HemisphereLight('#ffffff', colours.dark ? '#50565e' : '#c9c5bb', colours.dark ? 0.75 : 0.58),
    sun,
    sun.target
  );
  return group;
}

export function make_world(replay, colours) {
  const group = new THREE.Group();
  group.add(
    make_floor(replay, colours),
    make_shapes(replay, colours),
    make_border(replay, colours),
    make_light(replay, colours)
  );
  return group;
}
