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

// The head of a column of numbers, above its unit.
export function number_head(text, unit = null) {
  return element(
    'th',
    {scope: 'col', class: 'number'},
    element('span', {class: 'header'}, text),
    unit && element('span', {class: 'unit'}, unit)
  );
}

// A cell with a number and smaller lines below it; `label`: its name where rows are folded on small screens.
export function number_cell(label, value, ...lines) {
  const small = lines.map((line) => element('span', {class: 'interval'}, line));
  return element('td', {class: 'number', 'data-label': label}, element('span', {class: 'mean'}, value), small);
}

// The bodies of a table: the rows of each variant that has some, below its name if there are several.
export function bodies_of(data, variants, columns, rows_of) {
  return variants.map((variant) => {
    const rows = rows_of(variant);
    const title = data.scenarios.length > 1 && group_row(variant.label, columns);
    return rows.length > 0 && element('tbody', {}, title, rows);
  });
}

// The row above a group of rows.
export function group_row(title, columns) {
  return element(
    'tr',
    {class: 'group'},
    element('th', {scope: 'rowgroup', colspan: columns}, element('span', {}, title))
  );
}
