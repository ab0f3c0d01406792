// SPDX-License-Identifier: MIT
// theme.js: light or dark, as the reader's system has it until told otherwise.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';

  function set(theme) {
    document.documentElement.dataset.theme = theme;
    document.dispatchEvent(new CustomEvent('dmrp:theme', {detail: theme}));
  }

  function follow_system() {
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    set(dark.matches ? 'dark' : 'light');
    dark.addEventListener('change', () => set(dark.matches ? 'dark' : 'light'));
  }

  // Paper is white.
  function follow_printing() {
    let before = 'light';
    window.addEventListener('beforeprint', () => {
      before = document.documentElement.dataset.theme;
      set('light');
    });
    window.addEventListener('afterprint', () => set(before));
  }

  function button() {
    const made = dmrp.elements.element('button', {type: 'button', class: 'button theme-button', id: 'theme'}, 'Dark');
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

  dmrp.theme = {set, follow_system, follow_printing, button};
})(window.dmrp);
