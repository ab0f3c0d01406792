// SPDX-License-Identifier: MIT
// transport.js: the buttons and keys that control the clock of a replay.
import {element} from '../elements.js';

const SPEEDS = [0.5, 1, 2, 4, 8, 16];
const ICONS = {
  play: 'M4 2.5v11l9.5-5.5z',
  pause: 'M3.5 2.5h3.2v11H3.5zM9.3 2.5h3.2v11H9.3z',
  back: 'M3 2.5h2v11H3zM13 2.5v11L5.8 8z',
  forward: 'M11 2.5h2v11h-2zM3 2.5v11L10.2 8z',
};

function icon(name) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', ICONS[name]);
  svg.append(path);
  return svg;
}

function icon_button(name, label, id, pressed) {
  return element(
    'button',
    {
      type: 'button',
      class: 'button replay-icon',
      'aria-label': label,
      title: label,
      'data-testid': id,
      onclick: pressed,
    },
    icon(name)
  );
}

export function make_transport(clock) {
  const play = icon_button('play', 'Play (space)', 'replay-play', () => clock.toggle());
  play.classList.add('replay-play');
  const speed = element(
    'select',
    {
      'aria-label': 'speed of the replay',
      'data-testid': 'replay-speed',
      onchange: () => {
        clock.speed = Number(speed.value);
      },
    },
    SPEEDS.map((one) => element('option', {value: one, selected: one === 1}, `${one}×`))
  );
  let showed_playing = false;

  clock.on_change(() => {
    if (clock.playing === showed_playing) return;
    showed_playing = clock.playing;
    play.replaceChildren(icon(clock.playing ? 'pause' : 'play'));
    play.setAttribute('aria-label', clock.playing ? 'Pause (space)' : 'Play (space)');
  });

  return element(
    'div',
    {class: 'replay-transport'},
    play,
    icon_button('back', 'One sample back (left arrow)', 'replay-back', () => clock.step(-0.1)),
    icon_button('forward', 'One sample forward (right arrow)', 'replay-forward', () => clock.step(0.1)),
    speed
  );
}

// Space plays; arrow keys step by a sample, with Shift by a second; Home and End jump; a digit picks a robot, Escape
// none.
export function follow_keys(node, clock, handlers) {
  const actions = {
    ' ': () => clock.toggle(),
    ArrowLeft: (event) => clock.step(event.shiftKey ? -1 : -0.1),
    ArrowRight: (event) => clock.step(event.shiftKey ? 1 : 0.1),
    Home: () => clock.go(0),
    End: () => clock.go(clock.end),
    Escape: () => handlers.pick(null),
    '+': () => handlers.zoom(1.4),
    '-': () => handlers.zoom(1 / 1.4),
  };
  node.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === 'SELECT') return;
    if (event.key === ' ' && ['BUTTON', 'INPUT'].includes(event.target.tagName) && event.target.type !== 'range')
      return;
    const digit = /^[0-9]$/.test(event.key) ? () => handlers.pick(Number(event.key)) : null;
    const action = actions[event.key] || digit;
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
