// SPDX-License-Identifier: MIT
// stage.js: the picture of a replay: the flat map or the 3-D view, which is made when first opened, and the buttons for
// zoom and view.
import {element} from '../elements.js';
import * as numbers from '../numbers.js';
import {make_map} from './map.js';
import {follow_pointer} from './pointer.js';
import * as recording from './recording.js';

function tool(text, label, id, pressed) {
  return element(
    'button',
    {type: 'button', class: 'button', 'aria-label': label, title: label, 'data-testid': id, onclick: pressed},
    text
  );
}

const CAMERAS = {
  overview: 'camera: all robots from above',
  follow: 'camera: behind the picked robot',
  low: 'camera: at the height of people',
};
const LEAST_HEIGHT_PX = 220;
const NO_WEBGL = 'This browser offers no WebGL, which the 3-D view needs. The flat map shows the same.';

// handlers: pick(robot index or null), point(robot index or null), follow(whether), redraw(), room(): the most height
// of the picture in pixels, fills(): whether it is to have all of it. make_3d_view: replay_3d/view.js's make_view.
export function make_stage(handlers, make_3d_view) {
  const flat_canvas = element('canvas', {class: 'replay-canvas', 'data-testid': 'replay-map'});
  const message = element('p', {class: 'replay-message', role: 'status', hidden: true});
  const flat_button = tool('2-D', 'flat map', 'replay-2d', () => choose('flat'));
  const solid_button = tool('3-D', '3-D view', 'replay-3d', () => choose('solid'));
  const tip = element('div', {class: 'replay-tip', hidden: true});
  const cameras = element(
    'div',
    {class: 'segmented replay-cameras', hidden: true},
    Object.entries(CAMERAS).map(([preset, label]) =>
      tool(preset, label, `replay-camera-${preset}`, () => look_from(preset))
    )
  );
  const node = element(
    'div',
    {class: 'replay-stage', tabindex: 0, role: 'group', 'data-testid': 'replay-stage'},
    flat_canvas,
    cameras,
    tip,
    message
  );
  const tools = element(
    'div',
    {class: 'replay-tools'},
    element(
      'div',
      {class: 'segmented'},
      tool('−', 'zoom out', 'replay-zoom-out', () => zoom(1 / 1.4)),
      tool('+', 'zoom in', 'replay-zoom-in', () => zoom(1.4)),
      tool('⤢', 'show the whole world', 'replay-fit', fit),
      tool('◎', 'show where robots drive', 'replay-robots', fit_robots)
    ),
    element('div', {class: 'segmented'}, flat_button, solid_button)
  );
  const map = make_map(flat_canvas);
  let solid = null; // the 3-D view, made when it is first opened
  let loading = null; // the promise of the 3-D view while it loads
  let mode = 'flat';
  let wanted = 'flat'; // differs from mode while the 3-D view loads
  let scene = null;

  const current = () => (mode === 'solid' ? solid : map);

  function say(text) {
    message.textContent = text;
    message.hidden = text === '';
  }

  function show_mode() {
    flat_button.setAttribute('aria-pressed', String(mode === 'flat'));
    solid_button.setAttribute('aria-pressed', String(mode === 'solid'));
    flat_canvas.hidden = mode !== 'flat';
    if (solid) solid.canvas.hidden = mode !== 'solid';
    node.dataset.mode = mode === 'solid' ? '3d' : '2d';
    cameras.hidden = mode !== 'solid';
  }

  // Null, after a message, if there can be no 3-D view.
  async function load_solid() {
    try {
      const view = await make_3d_view();
      if (!view) say(NO_WEBGL);
      return view;
    } catch (error) {
      say(`The 3-D view cannot be unpacked: ${error.message}. The flat map shows the same.`);
      return null;
    }
  }

  function add_solid(view) {
    solid = view;
    flat_canvas.after(solid.canvas);
    follow_pointer(solid.canvas, {
      tap: (x, y) => handlers.pick(scene ? solid.robot_at(scene, x, y) : null),
      drag: (dx, dy, secondary) => {
        secondary ? solid.shift(dx, dy) : solid.orbit(dx, dy);
        handlers.redraw();
      },
      pinch: (factor) => zoom(factor),
      hover: (x, y) => handlers.point(x === null || !scene ? null : solid.robot_at(scene, x, y)),
    });
  }

  async function choose(chosen) {
    wanted = chosen;
    say('');
    if (chosen === 'solid' && !solid) {
      loading = loading || load_solid();
      const view = await loading;
      loading = null;
      if (view && !solid) add_solid(view);
      if (!solid || wanted !== chosen) return;
    }
    mode = chosen;
    show_mode();
    resize();
    handlers.redraw();
  }

  function zoom(factor, x, y) {
    mode === 'solid' ? solid.zoom_by(factor) : map.view.zoom_by(factor, x, y);
    show_zoom();
    handlers.redraw();
  }

  // On touch screens, a finger pans the zoomed map, and scrolls the page otherwise.
  function show_zoom() {
    flat_canvas.classList.toggle('zoomed', map.view.zoom > 1.001);
  }

  function fit() {
    current().fit ? current().fit() : map.view.fit();
    show_zoom();
    handlers.redraw();
  }

  function look_from(preset) {
    handlers.follow(preset === 'follow');
    solid.look_from(preset, scene);
    handlers.redraw();
  }

  // Shows the part of the world in which robots drive.
  function fit_robots() {
    const box = recording.active_box(scene.replay);
    mode === 'solid' ? solid.show_box(box) : map.view.show_box(box);
    show_zoom();
    handlers.redraw();
  }

  function hover(x, y) {
    handlers.point(x === null || !scene ? null : map.robot_at(scene, x, y));
    const words = x === null || !scene ? '' : map.words_at(scene, x, y);
    tip.hidden = words === '';
    if (words === '') return;
    tip.textContent = words;
    tip.style.left = `${Math.min(x + 14, Math.max(0, node.clientWidth - tip.offsetWidth - 4))}px`;
    tip.style.top = `${y > 60 ? y - 34 : y + 18}px`;
  }

  follow_pointer(flat_canvas, {
    tap: (x, y) => handlers.pick(scene ? map.robot_at(scene, x, y) : null),
    drag: (dx, dy) => {
      map.view.shift_by(dx, dy);
      handlers.redraw();
    },
    pinch: zoom,
    hover,
  });

  // The height follows the aspect of the world, limited so that time line and buttons are in sight together with it.
  function resize() {
    if (!scene) return;
    const [width, height] = [0, 1].map((axis) => scene.replay.upper[axis] - scene.replay.lower[axis]);
    const wished = handlers.fills() ? Infinity : (node.clientWidth * height) / width;
    node.style.height = `${Math.floor(Math.max(LEAST_HEIGHT_PX, Math.min(wished, handlers.room())))}px`;
    current().resize();
  }

  function show(shown) {
    scene = shown;
    map.view.show_world(scene.replay.lower, scene.replay.upper);
    node.setAttribute(
      'aria-label',
      `map of ${numbers.counted(
        scene.replay.robots.length,
        'robot'
      )}; space plays, arrow keys step, digits select a robot`
    );
    resize();
    show_zoom();
  }

  function draw(drawn) {
    scene = drawn;
    current().draw(scene);
  }

  show_mode();
  return {
    node,
    tools,
    show,
    draw,
    resize,
    zoom,
    say,
    canvas: () => (mode === 'solid' ? solid.canvas : flat_canvas),
    forget: () => map.forget(),
  };
}
