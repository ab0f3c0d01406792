// SPDX-License-Identifier: MIT
// view.js: the 3-D view of a replay, by three.js (r111). It draws only on request.
import {element} from '../elements.js';
import * as recording from '../replay/recording.js';
import * as bodies from './bodies.js';
import {make_camera} from './camera.js';
import {make_people} from './people.js';
import {make_world} from './world.js';
import {THREE, load_three} from './three.js';

const MANY_ROBOTS = 12;
const SHORT_TRAIL = 100; // samples
const LABEL_PX = 20;
const LABEL_PX_OF_MANY = 15;
const CONTACT_SEEN_S = 1.0;

function dispose(node) {
  node.traverse((part) => {
    if (part.geometry) part.geometry.dispose();
    if (!part.material) return;
    if (part.material.map) part.material.map.dispose();
    part.material.dispose();
  });
}

// The mark of a contact: a pole with a ball and a ring.
function make_contact_mark(colours) {
  const mark = new THREE.Group();
  const material = new THREE.MeshBasicMaterial({color: colours.bad});
  const pole = new THREE.Mesh(new THREE.CylinderBufferGeometry(0.04, 0.04, 2.4, 8), material);
  pole.position.y = 1.2;
  const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(0.2, 16, 12), material);
  ball.position.y = 2.4;
  mark.add(pole, ball, bodies.flat_ring(0.45, 0.6, colours.bad));
  return mark;
}

function build(replay, colours) {
  const stage = new THREE.Scene();
  stage.background = new THREE.Color(colours.surface);
  stage.add(make_world(replay, colours));
  const robots = replay.robots.map((robot) => bodies.make_robot(robot, colours));
  for (const robot of robots) stage.add(robot.body, robot.trail, robot.hits, ...robot.goals);
  const people = make_people(replay, colours);
  stage.add(...people.meshes);
  const contacts = replay.contacts.map((contact) => {
    const mark = make_contact_mark(colours);
    mark.position.set(contact.at[0], 0, -contact.at[1]);
    stage.add(mark);
    return mark;
  });
  return {stage, robots, people, contacts};
}

// Makes the mesh of a plan when it is first shown.
function show_plan(set, scene, robot, shown) {
  const {replay, at} = scene;
  const revision = replay.plan[at.k];
  for (const [index, mesh] of robot.plans) mesh.visible = shown && index === revision;
  const plan = replay.plans[revision];
  if (!shown || !plan || robot.plans.has(revision)) return;
  const path = plan.paths[set.robots.indexOf(robot)];
  const mesh = bodies.band(path.x, path.y, bodies.PLAN, robot.colour, 0.45);
  robot.plans.set(revision, mesh);
  set.stage.add(mesh);
}

function place_robots(set, scene, label_scale) {
  const {replay, at, picked, hovered, layers} = scene;
  const few = replay.robots.length <= MANY_ROBOTS;
  set.robots.forEach((robot, i) => {
    const known = replay.robots[i];
    const pose = recording.robot_pose(known, at);
    const marked = i === picked || i === hovered;
    const clear = few || marked;
    robot.body.position.set(pose.x, 0, -pose.y);
    robot.body.rotation.y = pose.theta;
    robot.vehicle.fail(known.state[at.k] === recording.FAILED);
    robot.vehicle.steer(recording.steering_angle(known, at));
    robot.picked.visible = marked;
    robot.label.scale.set(label_scale, label_scale, 1);
    robot.goals.forEach((goal, g) => {
      goal.visible = clear && g === Math.min(known.goal[at.k], robot.goals.length - 1);
    });
    robot.hits.visible = layers.scans && known.scans !== null && (picked === null || i === picked);
    if (robot.hits.visible) bodies.place_hits(robot.hits, known, at);
    const from = clear ? 0 : Math.max(0, at.k - SHORT_TRAIL);
    robot.trail.visible = layers.trails;
    robot.trail.geometry.setDrawRange(6 * from, 6 * (at.k - from));
    show_plan(set, scene, robot, layers.plans && clear);
  });
}

function place_contacts(set, scene) {
  scene.replay.contacts.forEach((contact, i) => {
    set.contacts[i].visible =
      scene.at.t >= contact.from - 1e-6 && scene.at.t <= Math.max(contact.to, contact.from + CONTACT_SEEN_S);
  });
}

// Null if the browser has no WebGL; rejects if three.js cannot be unpacked.
export async function make_view() {
  const canvas = element('canvas', {class: 'replay-canvas solid', 'data-testid': 'replay-view'});
  const options = {antialias: true, alpha: false, powerPreference: 'high-performance'};
  const context = canvas.getContext('webgl', options);
  if (!context) return null;
  await load_three();
  const renderer = new THREE.WebGLRenderer({canvas, context, ...options});
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFSoftShadowMap;
  const camera = make_camera();
  let set = null;
  let built_of = '';
  let size = [1, 1];
  let box = null;

  function rebuild(scene) {
    const wanted = `${scene.replay.trial} ${scene.colours.dark}`;
    if (wanted === built_of) return;
    if (set) dispose(set.stage);
    set = build(scene.replay, scene.colours);
    if (!box || built_of.split(' ')[0] !== String(scene.replay.trial)) first_look(scene.replay);
    built_of = wanted;
  }

  function resize() {
    size = [canvas.clientWidth, canvas.clientHeight];
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    renderer.setSize(size[0], size[1], false);
    camera.resize(...size);
  }

  function first_look(replay) {
    box = [replay.lower, replay.upper];
    camera.show_box(...recording.active_box(replay));
  }

  const fit = () => camera.show_box(...box);

  // The positions from which the world can be seen; `follow` stays behind the picked robot.
  function look_from(preset, scene) {
    const [lower, upper] = recording.active_box(scene.replay);
    if (preset === 'overview') camera.show_box(lower, upper);
    if (preset === 'low') camera.stand_before(lower, upper);
    if (preset === 'follow') camera.chase();
  }

  function draw(scene) {
    rebuild(scene);
    if (scene.follow && scene.picked !== null) {
      const robot = scene.replay.robots[scene.picked];
      const pose = recording.robot_pose(robot, scene.at);
      if (camera.chases) camera.look_along(recording.mean_heading(robot, scene.at));
      camera.look_at(pose.x, pose.y);
    }
    // three.js scales a sprite of constant size as if it were one unit from the lens
    const label_px = scene.replay.robots.length <= MANY_ROBOTS ? LABEL_PX : LABEL_PX_OF_MANY;
    const label_scale = (2 * Math.tan((camera.lens.fov * Math.PI) / 360) * label_px) / size[1];
    place_robots(set, scene, label_scale);
    place_contacts(set, scene);
    set.people.place(scene.at, scene.layers.people);
    renderer.render(set.stage, camera.lens);
  }

  function robot_at(scene, px, py) {
    let best = null;
    let nearest = 22;
    set.robots.forEach((robot, i) => {
      for (const height of [0.2, 1.1]) {
        // the body, its label
        const place = robot.body.position.clone().setY(height).project(camera.lens);
        const distance = Math.hypot(((place.x + 1) / 2) * size[0] - px, ((1 - place.y) / 2) * size[1] - py);
        if (distance < nearest) [nearest, best] = [distance, i];
      }
    });
    return best;
  }

  return {
    canvas,
    resize,
    fit,
    show_box: ([lower, upper]) => camera.show_box(lower, upper),
    look_from,
    draw,
    robot_at,
    orbit: camera.orbit,
    shift: camera.shift,
    zoom_by: camera.zoom_by,
  };
}
