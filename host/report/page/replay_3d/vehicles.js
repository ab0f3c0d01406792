// SPDX-License-Identifier: MIT
// vehicles.js: robots as what they are: discs with two wheels, flat transporters, cars with wheels that steer.
import * as solids from './solids.js';
import {THREE} from './three.js';

const DARK = late_colour('#24282d');
const RUBBER = late_colour('#17191c');
const METAL = late_colour('#b9c0c7');
const LAMP = late_colour('#fff3c4');

// three.js is loaded later than this module.
function late_colour(text) {
  return () => solids.colour_of(text);
}

function mesh_of(built) {
  const material = new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors});
  const mesh = new THREE.Mesh(built.geometry(), material);
  mesh.castShadow = true;
  mesh.receiveShadow = true;
  return mesh;
}

function lighter(colour, share) {
  return colour.clone().lerp(new THREE.Color('#ffffff'), share);
}

function add_lidar(built, x, height) {
  built.prism(solids.circle(x, 0, 0.06, 14), height, height + 0.05, DARK());
  built.prism(solids.circle(x, 0, 0.05, 14), height + 0.05, height + 0.09, METAL());
}

// The mark on the top that shows the heading.
function add_arrow(built, tip_x, size, height, colour) {
  built.prism(
    [
      [tip_x, 0],
      [tip_x - size, 0.55 * size],
      [tip_x - size, -0.55 * size],
    ],
    height,
    height + 0.012,
    colour
  );
}

// A body of revolution on two driven wheels, with a deck and a lidar in front.
function disc(robot, colour) {
  const built = solids.make_solids();
  const r = robot.radius;
  built.prism(solids.circle(0, 0, 0.8 * r), 0.05, 0.1, DARK());
  for (const side of [1, -1]) built.wheel(-0.05 * r, side * 0.78 * r, 0.1, 0.1, 0.05, RUBBER());
  built.wheel(-0.7 * r, 0, 0.035, 0.035, 0.025, RUBBER());
  built.prism(solids.circle(0, 0, r), 0.1, 0.22, colour, {slope: 0.06 * r});
  built.prism(solids.circle(0, 0, 0.92 * r), 0.22, 0.25, DARK());
  add_arrow(built, -0.05 * r, 0.75 * r, 0.25, lighter(colour, 0.75));
  add_lidar(built, 0.55 * r, 0.25);
  return {built, steered: []};
}

function bounds(parts) {
  const all = parts.flat();
  const range = (axis) => [Math.min(...all.map((p) => p[axis])), Math.max(...all.map((p) => p[axis]))];
  return {x: range(0), y: range(1)};
}

// A flat platform in the shape of its footprint, with a skirt, a load deck and lamps in front.
function transporter(robot, colour) {
  const built = solids.make_solids();
  for (const part of robot.parts) {
    built.prism(solids.shrunk(part, 0.05), 0.03, 0.1, DARK());
    built.prism(part, 0.1, 0.27, colour, {slope: 0.02});
    built.prism(solids.shrunk(part, 0.07), 0.27, 0.3, METAL(), {top_colour: lighter(colour, 0.55)});
  }
  const {x, y} = bounds(robot.parts);
  const width = y[1] - y[0];
  const middle = (y[0] + y[1]) / 2;
  built.prism(solids.rectangle(x[1] - 0.01, middle, 0.03, 0.6 * width), 0.17, 0.2, LAMP());
  add_arrow(built, x[1] - 0.15, Math.min(0.35, 0.4 * width), 0.3, DARK());
  add_lidar(built, x[1] - 0.08, 0.27);
  return {built, steered: []};
}

// A body above four wheels with a cabin; the front wheels steer.
function car(robot, colour) {
  const built = solids.make_solids();
  const {x, y} = bounds(robot.parts.length > 0 ? robot.parts : [solids.circle(0, 0, robot.radius)]);
  const [length, width] = [x[1] - x[0], y[1] - y[0]];
  const middle = [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2];
  const wheel_m = Math.min(0.16, 0.16 * length);
  const hull = robot.parts.length > 0 ? robot.parts : [solids.circle(0, 0, robot.radius)];
  for (const part of hull) built.prism(part, 0.6 * wheel_m, 0.36, colour, {slope: 0.05});
  const cabin = solids.rectangle(middle[0] - 0.08 * length, middle[1], 0.5 * length, 0.8 * width);
  const roof = solids.rectangle(middle[0] - 0.1 * length, middle[1], 0.36 * length, 0.66 * width);
  built.sides(cabin, 0.36, roof, 0.58, DARK());
  built.top(roof, 0.58, lighter(colour, 0.25));
  for (const side of [1, -1])
    built.prism(solids.rectangle(x[1] - 0.01, middle[1] + side * 0.32 * width, 0.03, 0.16 * width), 0.2, 0.27, LAMP());
  const rear_x = Math.max(x[0] + wheel_m, 0);
  const front_x = Math.min(x[1] - wheel_m, rear_x + (robot.wheelbase || 0.6 * length));
  const wheel_y = 0.46 * width;
  for (const side of [1, -1]) built.wheel(rear_x, middle[1] + side * wheel_y, wheel_m, wheel_m, 0.1, RUBBER());
  const steered = [1, -1].map((side) => {
    const wheel = solids.make_solids();
    wheel.wheel(0, 0, wheel_m, wheel_m, 0.1, RUBBER());
    return {wheel, at: [front_x, middle[1] + side * wheel_y]};
  });
  return {built, steered};
}

// {node, steer(angle), fail(whether)}: stands at the origin and looks along x.
export function make_vehicle(robot, colour_text) {
  const colour = solids.colour_of(colour_text);
  const make = robot.drive === 'ackermann' ? car : robot.parts.length > 0 ? transporter : disc;
  const {built, steered} = make(robot, colour);
  const node = new THREE.Group();
  const hull = mesh_of(built);
  const wheels = steered.map(({wheel, at}) => {
    const mesh = mesh_of(wheel);
    mesh.position.set(at[0], 0, -at[1]);
    return mesh;
  });
  node.add(hull, ...wheels);
  return {
    node,
    steer: (angle) => wheels.forEach((wheel) => wheel.rotation.set(0, angle, 0)),
    fail: (failed) => {
      hull.material.wireframe = failed;
    },
  };
}
