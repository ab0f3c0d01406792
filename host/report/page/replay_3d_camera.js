// SPDX-License-Identifier: MIT
// replay_3d_camera.js: a camera that goes round a point of the floor.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';
  const FIELD_OF_VIEW_DEG = 38;
  const LOWEST = 0.12;   // rad above the floor
  const HIGHEST = 1.55;
  const RADIANS_A_PIXEL = 0.008;

  function make_camera() {
    const lens = new THREE.PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.5, 500);
    const camera = {lens, target: [0, 0], distance: 50, azimuth: 0.45, elevation: 0.85};
    let farthest = 200;

    function apply() {
      const level = camera.distance * Math.cos(camera.elevation);
      lens.position.set(camera.target[0] + level * Math.sin(-camera.azimuth), camera.distance * Math.sin(camera.elevation),
        -camera.target[1] + level * Math.cos(camera.azimuth));
      lens.lookAt(camera.target[0], 0, -camera.target[1]);
      lens.near = Math.max(0.1, camera.distance / 60);
      lens.far = camera.distance * 4 + 100;
      lens.updateProjectionMatrix();
      lens.updateMatrixWorld();
    }

    // All of the box from above at a slant.
    camera.show_box = (lower, upper) => {
      const half = [(upper[0] - lower[0]) / 2, (upper[1] - lower[1]) / 2];
      camera.target = [lower[0] + half[0], lower[1] + half[1]];
      camera.azimuth = 0.45;
      camera.elevation = 0.85;
      const reach = 0.94 * Math.hypot(...half);
      camera.distance = reach / Math.tan(FIELD_OF_VIEW_DEG * Math.PI / 360) / Math.min(1, Math.max(0.6, lens.aspect));
      farthest = 2.5 * camera.distance;
      apply();
    };

    camera.resize = (width, height) => {
      lens.aspect = width / Math.max(1, height);
      apply();
    };

    camera.orbit = (dx, dy) => {
      camera.azimuth += RADIANS_A_PIXEL * dx;
      camera.elevation = Math.min(HIGHEST, Math.max(LOWEST, camera.elevation + RADIANS_A_PIXEL * dy));
      apply();
    };

    camera.shift = (dx, dy) => {
      const metres = camera.distance * 0.0014;
      const [cos, sin] = [Math.cos(camera.azimuth), Math.sin(camera.azimuth)];
      camera.target = [camera.target[0] - metres * (dx * cos - dy * sin), camera.target[1] + metres * (dy * cos + dx * sin)];
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

  dmrp.replay_3d_camera = {make_camera};
})(window.dmrp);
