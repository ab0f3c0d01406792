// SPDX-License-Identifier: MIT
// full_screen.js: lets the player fill the screen, or the window where a browser has no full screen for elements.
import {icon, icon_button} from './icons.js';

// Returns {button, toggle}; the class `filled` of `node` says whether it fills the screen.
export function make_full_screen(node, changed) {
  const is_filled = () => node.classList.contains('filled');

  function show(filled) {
    node.classList.toggle('filled', filled);
    const label = filled ? 'leave full screen (F)' : 'full screen (F)';
    button.replaceChildren(icon(filled ? 'smaller' : 'larger'));
    button.title = label;
    button.setAttribute('aria-label', label);
    changed();
  }

  async function toggle() {
    const filled = !is_filled();
    show(filled);
    try {
      if (filled) await node.requestFullscreen();
      else if (document.fullscreenElement === node) await document.exitFullscreen();
    } catch (refused) {
      // the window is filled instead
    }
  }

  const button = icon_button('larger', 'full screen (F)', 'replay-fill', toggle);
  document.addEventListener('fullscreenchange', () => {
    if (!document.fullscreenElement && is_filled()) show(false);
  });
  node.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && is_filled() && !document.fullscreenElement) show(false);
  });
  return {button, toggle};
}
