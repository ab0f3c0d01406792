// SPDX-License-Identifier: MIT
// scroll_box.js: a box in which a table that is too wide scrolls. Its edges show on which side the table goes on, and a
// line below names the columns that are out of sight.
import {element} from './elements.js';

const TOLERANCE_PX = 2;

function column_name(head) {
  return (head.querySelector('.header') || head).textContent.trim();
}

// The heads of the columns that lie wholly or partly behind the right edge.
function hidden_heads(box, table) {
  const right = box.getBoundingClientRect().right + TOLERANCE_PX;
  const heads = table.tHead ? [...table.tHead.rows[table.tHead.rows.length - 1].cells] : [];
  return heads.filter((head) => head.getBoundingClientRect().right > right && column_name(head) !== '');
}

function hint_words(names) {
  return `${names.length === 1 ? 'One more column' : `${names.length} more columns`}: ${names.join(', ')}`;
}

// Keeps the classes more-left and more-right of `frame` up to date: whether `box`, inside it, goes on there. Calls
// `changed` with whether it does to the right.
export function watch_edges(frame, box, changed = () => {}) {
  const show = () => {
    const right = box.scrollLeft + box.clientWidth < box.scrollWidth - TOLERANCE_PX;
    frame.classList.toggle('more-left', box.scrollLeft > TOLERANCE_PX);
    frame.classList.toggle('more-right', right);
    changed(right);
  };
  box.addEventListener('scroll', () => requestAnimationFrame(show), {passive: true});
  const observer = new ResizeObserver(show);
  for (const watched of [box, ...box.children]) observer.observe(watched);
}

// `attributes` of the scrolling element, a region that keys can scroll.
export function scroll_box(attributes, table) {
  const box = element('div', {tabindex: '0', role: 'region', ...attributes, class: 'table-scroll'}, table);
  const hint = element('button', {type: 'button', class: 'more-columns', hidden: true});
  const frame = element('div', {class: 'table-frame'}, box, hint);
  if (attributes.class) frame.classList.add(attributes.class);

  watch_edges(frame, box, (right) => {
    const heads = right ? hidden_heads(box, table) : [];
    hint.hidden = heads.length === 0;
    hint.textContent = heads.length === 0 ? '' : hint_words(heads.map(column_name));
  });
  hint.addEventListener('click', () => {
    const first_px = table.rows[0].cells[0].offsetWidth; // stays in sight
    const head = hidden_heads(box, table)[0];
    if (head) box.scrollLeft += head.getBoundingClientRect().left - box.getBoundingClientRect().left - first_px;
  });
  return frame;
}

// A table below its title, in a scroll box.
export function titled_table(id, title, note, table) {
  table.setAttribute('aria-labelledby', id);
  return element(
    'div',
    {class: 'titled'},
    element('h3', {id}, title),
    note && element('p', {class: 'about-table'}, note),
    scroll_box({'aria-labelledby': id}, table)
  );
}
