// SPDX-License-Identifier: MIT
// world.js: the static parts of the 3-D view: floor, walls, furniture, light.
// The world's (x, y, height) is three.js's (x, height, -y).
import * as look from '../replay/look.js';
import {make_materials} from './materials.js';
import * as solids from './solids.js';
import {THREE} from './three.js';

const SHADOW_PX = 2048;
const SOLID_M = 1.1; // walls are glass above this height
const SHELF_M = 1.2; // furniture of at least this height has shelves
const PLINTH_M = 0.08;
const BORDER_M = 0.15;

const outline_of = (shape) => shape.vertices || solids.circle(...shape.center, shape.radius);

function palette(colours) {
  const of = (light, dark) => solids.colour_of(colours.dark ? dark : light);
  return {
    floor: of('#e9e6e0', '#3b3f45'),
    border: of('#8f959c', '#565c64'),
    wall: of('#f3f0e9', '#9aa1a9'),
    plinth: of('#6d7680', '#4a5058'),
    cut: of('#4c545d', '#7b838c'), // where a wall is cut off
    glass: of('#7f93a6', '#9fb3c6'),
    table: of('#c8a27a', '#8a6f55'),
    seat: of('#8e9aa6', '#66707a'),
    shelf: of('#b08a64', '#7a6049'),
  };
}

function make_floor(to, replay, paint) {
  const [[left, bottom], [right, top]] = [replay.lower, replay.upper];
  const floor = [
    [left, bottom],
    [right, bottom],
    [right, top],
    [left, top],
  ];
  to.floor.top(floor, 0, paint.floor);
  const [x, y] = [(left + right) / 2, (bottom + top) / 2];
  const outer = solids.rectangle(x, y, right - left + 2 * BORDER_M, top - bottom + 2 * BORDER_M);
  to.plain.top(outer, -0.01, paint.border);
}

function add_wall(to, shape, paint) {
  const outline = outline_of(shape);
  to.plain.sides(outline, 0, outline, PLINTH_M, paint.plinth);
  to.plaster.sides(outline, PLINTH_M, outline, SOLID_M, paint.wall);
  to.plain.top(outline, SOLID_M, paint.cut);
  to.glass.prism(outline, SOLID_M, shape.height, paint.glass);
}

function add_furniture(to, shape, paint) {
  const outline = outline_of(shape);
  if (shape.height >= SHELF_M) {
    to.shelf.sides(outline, 0, outline, shape.height, paint.shelf);
    to.wood.top(outline, shape.height, paint.shelf);
  } else if (shape.height >= 0.6) {
    const board = Math.max(0.04, shape.height - 0.06);
    to.wood.sides(outline, board, outline, shape.height, paint.table);
    to.wood.top(outline, shape.height, paint.table);
    to.plain.prism(solids.shrunk(outline, 0.08), 0, board, paint.seat);
  } else {
    to.plain.prism(outline, 0, shape.height, paint.seat, {slope: Math.min(0.03, shape.height / 4)});
  }
}

function make_light(replay, colours) {
  const group = new THREE.Group();
  const width = replay.upper[0] - replay.lower[0];
  const depth = replay.upper[1] - replay.lower[1];
  const middle = [(replay.lower[0] + replay.upper[0]) / 2, (replay.lower[1] + replay.upper[1]) / 2];
  const reach = Math.hypot(width, depth) / 2 + 1;
  const sun = new THREE.DirectionalLight('#fff6e6', colours.dark ? 0.55 : 0.5);
  sun.position.set(middle[0] - 0.55 * reach, 1.5 * reach, -middle[1] + 0.7 * reach);
  sun.target.position.set(middle[0], 0, -middle[1]);
  sun.castShadow = true;
  sun.shadow.mapSize.set(SHADOW_PX, SHADOW_PX);
  sun.shadow.bias = -0.0008;
  Object.assign(sun.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 4 * reach});
  group.add(
    new THREE.HemisphereLight('#f4f8ff', colours.dark ? '#50565e' : '#b9b2a6', colours.dark ? 0.75 : 0.62),
    sun,
    sun.target
  );
  return group;
}

export function make_world(replay, colours) {
  const paint = palette(colours);
  const materials = make_materials();
  const to = Object.fromEntries(Object.keys(materials).map((name) => [name, solids.make_solids()]));
  make_floor(to, replay, paint);
  for (const shape of replay.shapes) look.is_wall(shape) ? add_wall(to, shape, paint) : add_furniture(to, shape, paint);
  const group = new THREE.Group();
  for (const [name, built] of Object.entries(to)) {
    if (built.empty()) continue;
    const mesh = new THREE.Mesh(built.geometry(), materials[name]);
    mesh.castShadow = name !== 'glass' && name !== 'floor';
    mesh.receiveShadow = name !== 'glass';
    if (name === 'glass') mesh.renderOrder = 1;
    group.add(mesh);
  }
  group.add(make_light(replay, colours));
  return group;
}
