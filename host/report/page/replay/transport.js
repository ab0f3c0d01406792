// SPDX-License-Identifier: MIT
// transport.js: the buttons and keys that control the clock of a replay.
import {element} from '../elements.js';
import {icon, icon_button} from './icons.js';

const SPEEDS = [0.5, 1, 2, 4, 8, 16];

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
// none; F fills the screen.
export function follow_keys(node, clock, handlers) {
  const actions = {
    ' ': () => clock.toggle(),
    ArrowLeft: (event) => clock.step(event.shiftKey ? -1 : -0.1),
    ArrowRight: (event) => clock.step(event.shiftKey ? 1 : 0.1),
    Home: () => clock.go(0),
    End: () => clock.go(clock.end),
    Escape: () => handlers.pick(null),
    f: () => handlers.fill(),
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
