// SPDX-License-Identifier: MIT
// people.js: people as figures of a few parts that walk: the legs swing with the way that they have gone.
import * as recording from '../replay/recording.js';
import * as solids from './solids.js';
import {THREE} from './three.js';

const HIP_M = 0.86;
const KNEE_M = 0.44; // length of the thigh; the shank takes the rest
const SHOULDER_M = 1.4;
const STRIDE_M = 1.35; // way of two steps
const FULL_SWING_MPS = 1.2; // speed from which the legs swing by SWING
const SWING = 0.5; // rad, of the thighs to each side
const STANDARD_RADIUS_M = 0.28;
const CLOTHES = [
  // [upper body, trousers], muted: colours are for robots
  ['#7d8893', '#454c55'],
  ['#a39a8b', '#54504a'],
  ['#7f8f86', '#414b48'],
];
const CLOTHES_DARK = [
  ['#a7b1bb', '#6c747d'],
  ['#c2b8a8', '#78736b'],
  ['#a3b3aa', '#67726e'],
];
const SKIN = '#c9a58a';
const HAIR = '#4a3c33';
const SHOE = '#26292d';

// Figures look along x; parts hang from the joint at their origin.
function trunk_of(clothes) {
  const built = solids.make_solids();
  const [upper, skin, hair] = [clothes, SKIN, HAIR].map(solids.colour_of);
  const torso = [
    [HIP_M - 0.08, 0.1, 0.15],
    [HIP_M + 0.1, 0.11, 0.16],
    [1.2, 0.12, 0.19],
    [SHOULDER_M, 0.11, 0.2],
    [SHOULDER_M + 0.06, 0.07, 0.1],
    [SHOULDER_M + 0.07, 0.045, 0.05],
  ];
  built.turned(0, 0, torso, upper);
  built.turned(0, 0, [[SHOULDER_M + 0.05, 0.05, 0.05], [1.53, 0.05, 0.05]], skin, 8);
  const head = (from, to, grown) =>
    Array.from({length: 6}, (_, i) => {
      const angle = from + ((to - from) * i) / 5;
      return [1.6 + 0.125 * grown * Math.sin(angle), 0.1 * grown * Math.cos(angle), 0.085 * grown * Math.cos(angle)];
    });
  built.turned(0.01, 0, head(-Math.PI / 2, Math.PI / 2, 1), skin);
  built.turned(-0.012, 0, head(0.1, Math.PI / 2, 1.1), hair);
  return built.geometry();
}

function limb(profile, colour, foot = null) {
  const built = solids.make_solids();
  built.turned(0, 0, profile, solids.colour_of(colour), 8);
  if (foot !== null) {
    const shoe = solids.rectangle(0.05, 0, 0.25, 0.09);
    built.prism(shoe, foot, foot + 0.08, solids.colour_of(SHOE), {slope: 0.02});
  }
  return built.geometry();
}

function parts_of(colours) {
  const clothes = colours.dark ? CLOTHES_DARK : CLOTHES;
  const shank_m = HIP_M - KNEE_M;
  return {
    trunks: clothes.map(([upper]) => trunk_of(upper)),
    arms: clothes.map(([upper]) =>
      limb(
        [
          [-0.56, 0.02, 0.02],
          [-0.5, 0.04, 0.035],
          [-0.28, 0.045, 0.045],
          [0, 0.055, 0.055],
          [0.04, 0.02, 0.02],
        ],
        upper
      )
    ),
    thighs: clothes.map(([, trousers]) =>
      limb(
        [
          [-KNEE_M, 0.06, 0.06],
          [0, 0.085, 0.085],
          [0.05, 0.05, 0.05],
        ],
        trousers
      )
    ),
    shanks: clothes.map(([, trousers]) =>
      limb(
        [
          [-shank_m + 0.06, 0.045, 0.045],
          [0, 0.062, 0.062],
          [0.03, 0.03, 0.03],
        ],
        trousers,
        -shank_m
      )
    ),
  };
}

// The way gone and the heading of a person at each sample; standing people keep their heading.
function gait_of(person) {
  const count = person.x.length;
  const gone = new Float32Array(count);
  const headings = new Float32Array(count);
  let heading = null;
  for (let k = 0; k < count; ++k) {
    const [a, b] = [Math.max(0, k - 2), Math.min(count - 1, k + 2)];
    const step = [person.x[b] - person.x[a], person.y[b] - person.y[a]];
    if (k > 0) gone[k] = gone[k - 1] + Math.hypot(person.x[k] - person.x[k - 1], person.y[k] - person.y[k - 1]);
    if (Math.hypot(...step) > 0.03) {
      const now = Math.atan2(step[1], step[0]);
      if (heading === null) headings.fill(now, 0, k);
      // the shorter way round, so that headings can be interpolated
      heading = heading === null ? now : heading + Math.atan2(Math.sin(now - heading), Math.cos(now - heading));
    }
    headings[k] = heading === null ? 0 : heading;
  }
  return {gone, headings};
}

// {meshes, place(at, shown)}.
export function make_people(replay, colours) {
  const geometry = parts_of(colours);
  const material = new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors});
  const gaits = replay.people.map(gait_of);
  const kinds = geometry.trunks.length;
  const all = {};
  for (const [name, made] of Object.entries(geometry))
    all[name] = made.map((one) => {
      const mesh = new THREE.InstancedMesh(one, material, Math.max(1, 2 * replay.people.length));
      mesh.castShadow = true;
      mesh.frustumCulled = false;
      return mesh;
    });
  const meshes = Object.values(all).flat();

  const body = new THREE.Matrix4();
  const joint = new THREE.Matrix4();
  const turn = new THREE.Matrix4();

  function put(mesh, matrix) {
    mesh.setMatrixAt(mesh.count++, matrix);
  }

  // Hangs a part at a place of its parent, turned about the axis to the left: positive swings it ahead.
  function hung(parent, x, height, y, angle) {
    joint.makeTranslation(x, height, -y).multiply(turn.makeRotationZ(angle));
    return parent.clone().multiply(joint);
  }

  function place_one(person, gait, pose, at) {
    const k = Math.min(person.x.length - 1, at.k - person.from);
    const next = Math.min(person.x.length - 1, k + 1);
    const between = (values) => values[k] + (values[next] - values[k]) * at.fraction;
    const speed = (gait.gone[Math.min(person.x.length - 1, k + 3)] - gait.gone[Math.max(0, k - 3)]) / 0.6;
    const strength = Math.min(1, speed / FULL_SWING_MPS);
    const phase = (2 * Math.PI * between(gait.gone)) / STRIDE_M + person.id;
    const wide = Math.min(1.15, Math.max(0.85, person.radius / STANDARD_RADIUS_M));
    const kind = person.id % kinds;

    body.makeTranslation(pose.x, 0.02 * strength * Math.cos(2 * phase), -pose.y);
    body.multiply(turn.makeRotationY(between(gait.headings)));
    body.multiply(turn.makeScale(wide, 1, wide));
    put(all.trunks[kind], body);
    for (const side of [1, -1]) {
      const swing = side * SWING * strength * Math.sin(phase);
      const lift = strength * Math.max(0, side * Math.cos(phase)); // the leg that comes forward is bent
      const thigh = hung(body, 0, HIP_M, 0.09 * side, swing + 0.25 * lift);
      put(all.thighs[kind], thigh);
      put(all.shanks[kind], hung(thigh, 0, -KNEE_M, 0, -0.85 * lift - 0.05));
      put(all.arms[kind], hung(body, 0, SHOULDER_M - 0.02, 0.24 * side, -0.7 * swing + 0.08));
    }
  }

  function place(at, shown) {
    for (const mesh of meshes) mesh.count = 0;
    if (shown)
      replay.people.forEach((person, i) => {
        const pose = recording.person_pose(person, at);
        if (pose) place_one(person, gaits[i], pose, at);
      });
    for (const mesh of meshes) mesh.instanceMatrix.needsUpdate = true;
  }

  return {meshes, place};
}
