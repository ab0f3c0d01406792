// SPDX-License-Identifier: MIT
// materials.js: the surfaces of floor, walls and furniture. Their textures are drawn here, in grey, and take the
// colours of the solids.
import {THREE} from './three.js';

const TEXTURE_PX = 256;

// The same speckles in every report.
function make_noise() {
  let state = 12345;
  return () => {
    state = (1103515245 * state + 12345) % 2147483648;
    return state / 2147483648;
  };
}

function texture(metres, draw) {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = TEXTURE_PX;
  const context = canvas.getContext('2d');
  context.fillStyle = '#ffffff';
  context.fillRect(0, 0, TEXTURE_PX, TEXTURE_PX);
  draw(context, make_noise());
  const made = new THREE.CanvasTexture(canvas);
  made.wrapS = made.wrapT = THREE.RepeatWrapping;
  made.repeat.set(1 / metres, 1 / metres);
  made.anisotropy = 4;
  return made;
}

function speckle(context, noise, count, strength) {
  for (let i = 0; i < count; ++i) {
    context.fillStyle = `rgba(0, 0, 0, ${strength * noise()})`;
    context.fillRect(TEXTURE_PX * noise(), TEXTURE_PX * noise(), 1 + 2 * noise(), 1 + 2 * noise());
  }
}

// Stone tiles of 1 m, two by two, in slightly different shades.
function tiles(context, noise) {
  const size = TEXTURE_PX / 2;
  for (const [x, y] of [
    [0, 0],
    [size, 0],
    [0, size],
    [size, size],
  ]) {
    context.fillStyle = `rgba(0, 0, 0, ${0.035 * noise()})`;
    context.fillRect(x, y, size, size);
  }
  speckle(context, noise, 900, 0.07);
  context.strokeStyle = 'rgba(0, 0, 0, 0.16)';
  context.lineWidth = 1.5;
  for (const at of [0, size, TEXTURE_PX]) {
    context.strokeRect(at, -2, 0, TEXTURE_PX + 4);
    context.strokeRect(-2, at, TEXTURE_PX + 4, 0);
  }
}

function grain(context, noise) {
  for (let y = 0; y < TEXTURE_PX; y += 2) {
    context.fillStyle = `rgba(0, 0, 0, ${0.1 * noise()})`;
    context.fillRect(0, y, TEXTURE_PX, 1 + noise());
  }
}

// Boards every half metre with things on them.
function shelves(context, noise) {
  context.fillStyle = 'rgba(0, 0, 0, 0.3)';
  context.fillRect(0, 0, TEXTURE_PX, TEXTURE_PX);
  const board = TEXTURE_PX / 2;
  for (const y of [0, board]) {
    for (let x = 0; x < TEXTURE_PX; ) {
      const width = 8 + 22 * noise();
      const height = board * (0.45 + 0.4 * noise());
      context.fillStyle = `rgba(${255 * noise()}, ${190 * noise()}, ${120 * noise()}, 0.28)`;
      context.fillRect(x, y + board - 8 - height, width - 2, height);
      x += width;
    }
    context.fillStyle = '#ffffff';
    context.fillRect(0, y + board - 8, TEXTURE_PX, 8);
  }
}

const lambert = (map, more = {}) => new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, map, ...more});

export function make_materials() {
  return {
    floor: lambert(texture(2, tiles)),
    plaster: lambert(texture(2, (context, noise) => speckle(context, noise, 2000, 0.03))),
    wood: lambert(texture(1, grain)),
    shelf: lambert(texture(1, shelves)),
    plain: lambert(null),
    glass: lambert(null, {transparent: true, opacity: 0.14, depthWrite: false}),
  };
}
