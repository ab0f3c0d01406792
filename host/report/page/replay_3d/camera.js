// SPDX-License-Identifier: MIT
// camera.js: a camera that orbits a point of the floor.
import {THREE} from './three.js';

const FIELD_OF_VIEW_DEG = 38;
const LOWEST = 0.12; // rad above the floor
const HIGHEST = 1.55;
const BOX_HEIGHT_M = 2;
const FITTING_ROUNDS = 8;
const FILLED = 0.94; // share of the picture that the box fills
const RADIANS_A_PIXEL = 0.008;
const LOW_HEIGHT_M = 0.5; // of the point that is looked at
const LOW_ELEVATION = 0.24; // rad
const MOST_LOW_M = 14;
const CHASE_ELEVATION = 0.42;
const CHASE_M = 7;

export function make_camera() {
  const lens = new THREE.PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.5, 500);
  const camera = {lens, target: [0, 0], height: 0, distance: 50, azimuth: 0.3, elevation: 0.9, chases: false};
  let farthest = 200;

  function apply() {
    const level = camera.distance * Math.cos(camera.elevation);
    lens.position.set(
      camera.target[0] + level * Math.sin(-camera.azimuth),
      camera.height + camera.distance * Math.sin(camera.elevation),
      -camera.target[1] + level * Math.cos(camera.azimuth)
    );
    lens.lookAt(camera.target[0], camera.height, -camera.target[1]);
    lens.near = Math.max(0.1, camera.distance / 60);
    lens.far = camera.distance * 4 + 100;
    lens.updateProjectionMatrix();
    lens.updateMatrixWorld();
  }

  function stop_chasing() {
    camera.chases = false;
    camera.height = 0;
  }

  // Shows the whole box obliquely from above.
  camera.show_box = (lower, upper) => {
    const half = [(upper[0] - lower[0]) / 2, (upper[1] - lower[1]) / 2];
    camera.target = [lower[0] + half[0], lower[1] + half[1]];
    stop_chasing();
    camera.azimuth = 0.3;
    camera.elevation = 0.9;
    camera.distance = 2 * Math.hypot(...half);
    for (let round = 0; round < FITTING_ROUNDS; ++round) fit_to(lower, upper);
    farthest = 2.5 * camera.distance;
    apply();
  };

  // From the height of a person's eyes or a little more, at the long side of the box.
  camera.stand_before = (lower, upper) => {
    stop_chasing();
    const size = [upper[0] - lower[0], upper[1] - lower[1]];
    camera.target = [(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2];
    camera.height = LOW_HEIGHT_M;
    camera.azimuth = size[0] >= size[1] ? Math.PI / 2 - 0.35 : 0.35;
    camera.elevation = LOW_ELEVATION;
    camera.distance = Math.min(MOST_LOW_M, 0.5 * Math.max(...size));
    apply();
  };

  // Behind and above the point that look_at() names, along the direction that look_along() names.
  camera.chase = () => {
    camera.chases = true;
    camera.height = LOW_HEIGHT_M;
    camera.elevation = CHASE_ELEVATION;
    camera.distance = CHASE_M;
    apply();
  };

  camera.look_along = (heading) => {
    camera.azimuth = Math.PI / 2 - heading;
  };

  // Changes distance and target so that the box fills the picture better.
  function fit_to(lower, upper) {
    apply();
    const seen = [];
    for (const x of [lower[0], upper[0]])
      for (const y of [lower[1], upper[1]])
        for (const height of [0, BOX_HEIGHT_M]) seen.push(new THREE.Vector3(x, height, -y).project(lens));
    const range = (axis) => [Math.min(...seen.map((one) => one[axis])), Math.max(...seen.map((one) => one[axis]))];
    const [[left, right], [bottom, top]] = [range('x'), range('y')];
    const half_height_m = camera.distance * Math.tan((FIELD_OF_VIEW_DEG * Math.PI) / 360);
    const aside = ((left + right) / 2) * half_height_m * lens.aspect;
    const away = (((bottom + top) / 2) * half_height_m) / Math.sin(camera.elevation);
    const [cos, sin] = [Math.cos(camera.azimuth), Math.sin(camera.azimuth)];
    camera.target = [camera.target[0] + aside * cos + away * sin, camera.target[1] - aside * sin + away * cos];
    camera.distance *= Math.max(right - left, top - bottom) / 2 / FILLED;
  }

  camera.resize = (width, height) => {
    lens.aspect = width / Math.max(1, height);
    apply();
  };

  camera.orbit = (dx, dy) => {
    camera.chases = false;
    camera.azimuth += RADIANS_A_PIXEL * dx;
    camera.elevation = Math.min(HIGHEST, Math.max(LOWEST, camera.elevation + RADIANS_A_PIXEL * dy));
    apply();
  };

  camera.shift = (dx, dy) => {
    const metres = camera.distance * 0.0014;
    const [cos, sin] = [Math.cos(camera.azimuth), Math.sin(camera.azimuth)];
    camera.target = [
      camera.target[0] - metres * (dx * cos - dy * sin),
      camera.target[1] + metres * (dx * sin + dy * cos),
    ];
    apply();
  };

  camera.zoom_by = (factor) => {
    camera.distance = Math.min(farthest, Math.max(2, camera.distance / factor));
    apply();
  };

  camera.look_at = (x, y) => {
    camera.target = [x, y];
    apply();
  };

  return camera;
}
