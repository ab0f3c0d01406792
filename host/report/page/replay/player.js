// SPDX-License-Identifier: MIT
// player.js: the replay of chosen trials. mount() builds it into its section once; open() shows a trial.
//
// For tests and other scripts: data-testid of the parts is "replay-" and combination, trial, stage, map, 2d, 3d, fit,
// robots, fill, save-picture, save-video, save-curves,
// play, back, forward, speed, scrub, time, robot-N, events, follow, plans, trails, people, scans. The
// section carries the id of the shown trial as data-trial once it can be played.
import {element} from '../elements.js';
import {choice_words, left_out_words, make_chooser, trial_summary} from './chooser.js';
import {make_clock} from './clock.js';
import {make_curves} from './curves.js';
import {all_events} from './events.js';
import {make_full_screen} from './full_screen.js';
import {make_event_list, make_robot_list} from './lists.js';
import * as look from './look.js';
import * as recording from './recording.js';
import {make_saving} from './saving.js';
import {make_stage} from './stage.js';
import {make_time_line} from './time_line.js';
import {follow_keys, make_transport} from './transport.js';

const KEY =
  'Solid: trail; thin, ahead of a robot: the route that leads it around something. ' +
  'Dotted: current plan, with a small ring at the planned position. ' +
  'Large rings: goals. Grey: people.';
const SCANS_KEY = " Dots in a robot's colour: lidar hits.";
const ROOM_PX = 16; // around the parts of the player
const BEFORE_EVENT_S = 2;
let player = null;

function summary_words(data, entry, replay) {
  return `${trial_summary(data, entry)}: ended after ${replay.end.toFixed(1)} s, ${replay.reason}.`;
}

function make_player(section, data, make_3d_view) {
  const clock = make_clock();
  const layers = {plans: true, trails: true, people: true, scans: true};
  const scene = {
    replay: null,
    at: null,
    picked: null,
    hovered: null,
    follow: false,
    layers,
    events: [],
    colours: null,
    whole_trails: false,
  };
  let latest = 0; // number of the last request; results of older ones are dropped

  const stage = make_stage({pick, point, follow, redraw, room, fills}, make_3d_view);
  const time_line = make_time_line(data, {jump, go: seek});
  const curves = make_curves({pick, point, go: seek});
  const robots = make_robot_list({pick, point});
  const event_list = make_event_list({jump});
  const chooser = make_chooser(data, open);
  const summary = element('p', {class: 'note replay-summary', 'aria-live': 'polite'});

  function layer_box(name, title) {
    const box = element('input', {
      type: 'checkbox',
      checked: layers[name],
      'data-testid': `replay-${name}`,
      onchange: () => {
        layers[name] = box.checked;
        redraw();
      },
    });
    return element('label', {class: 'control check'}, box, element('span', {}, title));
  }

  const follow_box = element('input', {
    type: 'checkbox',
    'data-testid': 'replay-follow',
    onchange: () => {
      follow(follow_box.checked);
      if (scene.follow && stage.node.dataset.mode === '2d') stage.zoom(2.5);
      redraw();
    },
  });
  const scan_box = layer_box('scans', 'lidar');
  const boxes = element(
    'div',
    {class: 'replay-layers'},
    layer_box('plans', 'plans'),
    layer_box('trails', 'trails'),
    layer_box('people', 'people'),
    scan_box,
    element('label', {class: 'control check'}, follow_box, element('span', {}, 'follow'))
  );

  const saving = make_saving(clock, {
    picture: () => {
      redraw();
      return stage.canvas();
    },
    curves: () => curves.node,
    trial: () => scene.replay.trial,
    say: stage.say,
  });
  boxes.append(saving.node);

  const key = element('p', {class: 'note replay-key'});
  const controls = element('div', {class: 'replay-controls'}, make_transport(clock), stage.tools, boxes);
  const node = element(
    'div',
    {class: 'replay-player'},
    element('div', {class: 'replay-main'}, stage.node, time_line.node, controls, key),
    element('div', {class: 'replay-side'}, robots.node, curves.node, event_list.node)
  );
  const full_screen = make_full_screen(node, () => requestAnimationFrame(resize));
  stage.tools.append(full_screen.button);
  follow_keys(node, clock, {pick, zoom: stage.zoom, fill: full_screen.toggle});

  function redraw() {
    if (!scene.replay) return;
    scene.at = recording.moment(scene.replay, clock.t);
    stage.draw(scene);
    time_line.draw(clock.t);
    curves.draw(scene.at, scene.picked, scene.hovered);
    robots.draw(scene.at, clock.playing);
    event_list.draw(clock.t, clock.playing);
  }

  function pick(index) {
    if (index !== null && (!scene.replay || index >= scene.replay.robots.length)) return;
    scene.picked = index === scene.picked ? null : index;
    robots.mark(scene);
    curves.mark(scene);
    redraw();
  }

  // The robot at which the pointer is, on the map, in the list or in the curves.
  function point(index) {
    if (index === scene.hovered || !scene.replay) return;
    scene.hovered = index;
    robots.mark(scene);
    curves.mark(scene);
    redraw();
  }

  function fills() {
    return node.classList.contains('filled');
  }

  // The height for the picture with which everything from the title of the section to the buttons is in the window.
  function room() {
    if (scene.whole_trails) return 0.75 * node.clientWidth;
    const below = time_line.node.offsetHeight + controls.offsetHeight + 3 * ROOM_PX;
    if (fills()) return window.innerHeight - below;
    const navigation = document.getElementById('contents').offsetHeight;
    const title = section.querySelector('h2').getBoundingClientRect().top;
    return window.innerHeight - below - navigation - ROOM_PX - (stage.node.getBoundingClientRect().top - title);
  }

  // Keeps the picked robot in the middle of the picture; the first one if none is picked.
  function follow(follows) {
    scene.follow = follows;
    follow_box.checked = follows;
    if (follows && scene.picked === null && scene.replay && scene.replay.robots.length > 0) pick(0);
  }

  function seek(t) {
    clock.pause();
    clock.go(t);
  }

  function jump(event) {
    seek(event.from);
    if (event.robots.length > 0 && scene.picked !== event.robots[0]) pick(event.robots[0]);
  }

  function show(replay) {
    scene.replay = replay;
    scene.picked = null;
    scene.hovered = null;
    scene.events = all_events(replay);
    scene.at = recording.moment(replay, 0);
    scene.colours = look.read_colours();
    scan_box.hidden = replay.robots.every((robot) => robot.scans === null);
    key.textContent = KEY + (scan_box.hidden ? '' : SCANS_KEY);
    robots.node.hidden = replay.robots.length === 0;
    curves.node.hidden = robots.node.hidden || replay.end === 0; // without a plan no robot moves
    robots.show(replay);
    robots.mark(scene);
    event_list.show(scene.events);
    time_line.show(replay, scene.events);
    stage.show(scene);
    curves.show(replay, scene.events);
    clock.begin(replay.end);
  }

  // A reader who chose this trial wants to look just before its first contact or failure.
  function go_to_event() {
    const event = scene.events.find(({kind}) => kind === 'contact' || kind === 'failure');
    if (event) clock.go(event.from - BEFORE_EVENT_S);
  }

  async function open(trial, at_event = false) {
    const entry = data.replays.find((one) => one.trial === trial);
    if (!entry) return false;
    const request = ++latest;
    clock.pause();
    saving.stop();
    chooser.show(trial);
    delete section.dataset.trial;
    try {
      const replay = await recording.load(document.getElementById(entry.element));
      if (request !== latest) return false;
      stage.say('');
      summary.textContent = summary_words(data, entry, replay);
      show(replay);
      if (at_event) go_to_event();
    } catch (error) {
      if (request === latest) stage.say(`This replay cannot be unpacked: ${error.message}`);
      return false;
    }
    section.dataset.trial = trial;
    return true;
  }

  function relook() {
    scene.colours = look.read_colours();
    stage.forget();
    redraw();
  }

  function resize() {
    time_line.resize();
    stage.resize();
    curves.resize();
    curves.mark(scene);
    redraw();
  }

  // Paper shows this moment and the whole trails, as wide as a page.
  function print(begins) {
    clock.pause();
    scene.whole_trails = begins;
    node.classList.toggle('printed', begins);
    resize();
  }

  let width = 0;
  new ResizeObserver(() => {
    if (node.clientWidth === width) return;
    width = node.clientWidth;
    requestAnimationFrame(resize);
  }).observe(node);
  window.addEventListener('resize', () => requestAnimationFrame(resize));
  window.addEventListener('beforeprint', () => print(true));
  window.addEventListener('afterprint', () => print(false));
  document.addEventListener('dmrp:theme', relook);
  clock.on_change(redraw);
  return {node, chooser: chooser.node, summary, open};
}

function notes(data) {
  const words = [
    ...left_out_words(data),
    'To add the replay of another recorded trial: dmrp-host report RUN_DIR --replay TRIAL',
  ];
  return words.map((sentence) => element('p', {class: 'note'}, sentence));
}

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.replays.length + data.replays_left_out.length > 0 ? null : 'no trace was recorded';
}

// make_3d_view: replay_3d/view.js's make_view. Resolves when the first replay is shown.
export function mount(body, data, make_3d_view) {
  if (data.replays.length === 0) {
    body.append(element('p', {class: 'note'}, 'This report embeds no replay.'), ...notes(data));
    return;
  }
  player = make_player(body.closest('section'), data, make_3d_view);
  const choice = choice_words(data);
  body.append(
    player.chooser,
    player.summary,
    player.node,
    choice ? element('p', {class: 'note'}, choice) : '',
    ...notes(data)
  );
  const first = data.replays.find((replay) => replay.why.includes('median')) || data.replays[0];
  return player.open(first.trial);
}

// Two seconds before the trial's first contact or failure. Resolves to whether the trial can be played now.
export function open(trial) {
  return player ? player.open(trial, true) : Promise.resolve(false);
}
