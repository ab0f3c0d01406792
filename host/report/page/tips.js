// SPDX-License-Identifier: MIT
// tips.js: the tooltip. An element with data-about is explained by it: to a mouse that points at it, to a key that
// reaches it, to a finger that taps it.
import {element, fill} from './elements.js';

const ROOM_PX = 8; // between tooltip, target and window
let explained = null; // the element whose data-about is shown

// Places the tooltip near `target`, inside the window.
export function show_tip(target, ...content) {
  const tip = document.getElementById('tip');
  fill(tip, content);
  tip.hidden = false;
  explained = null;
  const of = target.getBoundingClientRect();
  const own = tip.getBoundingClientRect();
  const most = window.innerWidth - own.width - ROOM_PX;
  const left = Math.min(Math.max(ROOM_PX, of.left + of.width / 2 - own.width / 2), most);
  const above = of.top - own.height - ROOM_PX;
  tip.style.left = `${left}px`;
  tip.style.top = `${above > ROOM_PX ? above : of.bottom + ROOM_PX}px`;
}

export function hide_tip() {
  document.getElementById('tip').hidden = true;
  explained = null;
}

// An abbreviation or a mark with its meaning.
export function explained_mark(text, about, attributes = {}) {
  return element('button', {type: 'button', class: 'explained', ...attributes, 'data-about': about}, text);
}

function explain(event) {
  const target = event.target instanceof Element ? event.target.closest('[data-about]') : null;
  if (target === explained) return;
  if (target) {
    show_tip(target, target.dataset.about);
    explained = target;
  } else if (explained) {
    hide_tip();
  }
}

export function explain_on_demand() {
  document.addEventListener('pointerover', (event) => {
    if (event.pointerType === 'mouse') explain(event);
  });
  for (const kind of ['click', 'focusin']) document.addEventListener(kind, explain);
  document.addEventListener('keydown', (event) => {
    if (event.key === 'Escape' && explained) hide_tip();
  });
  document.addEventListener('scroll', () => explained && hide_tip(), {passive: true, capture: true});
}
