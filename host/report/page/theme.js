// SPDX-License-Identifier: MIT
// theme.js: the light and the dark theme; the system's preference until the reader chooses.
import {element} from './elements.js';

export function set(theme) {
  document.documentElement.dataset.theme = theme;
  document.dispatchEvent(new CustomEvent('dmrp:theme', {detail: theme}));
}

export function follow_system() {
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  set(dark.matches ? 'dark' : 'light');
  dark.addEventListener('change', () => set(dark.matches ? 'dark' : 'light'));
}

// Prints in the light theme.
export function follow_printing() {
  let before = 'light';
  window.addEventListener('beforeprint', () => {
    before = document.documentElement.dataset.theme;
    set('light');
  });
  window.addEventListener('afterprint', () => set(before));
}

export function button() {
  const made = element('button', {type: 'button', class: 'button theme-button', id: 'theme'}, 'Dark');
  const show = () => {
    const dark = document.documentElement.dataset.theme === 'dark';
    made.textContent = dark ? 'Light' : 'Dark';
    made.setAttribute('aria-label', `Show in ${dark ? 'light' : 'dark'} colours`);
  };
  made.addEventListener('click', () => set(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'));
  document.addEventListener('dmrp:theme', show);
  show();
  return made;
}
