// SPDX-License-Identifier: MIT
// icons.js: the pictures on the buttons of the replay.
import {element} from '../elements.js';

const PATHS = {
  play: 'M4 2.5v11l9.5-5.5z',
  pause: 'M3.5 2.5h3.2v11H3.5zM9.3 2.5h3.2v11H9.3z',
  back: 'M3 2.5h2v11H3zM13 2.5v11L5.8 8z',
  forward: 'M11 2.5h2v11h-2zM3 2.5v11L10.2 8z',
  larger: 'M2 2h5v2H4v3H2zM9 2h5v5h-2V4H9zM2 9h2v3h3v2H2zM12 9h2v5H9v-2h3z',
  smaller: 'M5 2h2v5H2V5h3zM9 2h2v3h3v2H9zM2 9h5v5H5v-3H2zM9 9h5v2h-3v3H9z',
};

export function icon(name) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', PATHS[name]);
  svg.append(path);
  return svg;
}

export function icon_button(name, label, id, pressed) {
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
