// SPDX-License-Identifier: MIT
// elements.js: builds the page's elements.

function append(parent, child) {
  if (child === null || child === undefined || child === false) return;
  if (Array.isArray(child)) child.forEach((one) => append(parent, one));
  else parent.append(child);
}

// element('td', {class: 'number', onclick: f}, 'text', [more, elements]). Omits attributes that are null or false.
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value === true ? '' : value);
  }
  append(made, children);
  return made;
}

// For screen readers alone.
export function hidden(text) {
  return element('span', {class: 'visually-hidden'}, text);
}

export function fill(parent, ...children) {
  parent.textContent = '';
  append(parent, children);
}

// The head of a table with one row.
export function head_row(...cells) {
  return element('thead', {}, element('tr', {}, cells));
}

// The row above a group of rows.
export function group_row(title, columns) {
  return element(
    'tr',
    {class: 'group'},
    element('th', {scope: 'rowgroup', colspan: columns}, element('span', {}, title))
  );
}
