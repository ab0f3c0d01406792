// SPDX-License-Identifier: MIT
// svg_files.js: figures of the page as SVG files that need no style sheet: plots as they are, tables as lines, boxes
// and texts where the browser has placed them.
import {element} from './elements.js';

const SVG = 'http://www.w3.org/2000/svg';
const STYLES = [
  'fill',
  'fill-opacity',
  'stroke',
  'stroke-width',
  'stroke-opacity',
  'stroke-dasharray',
  'stroke-linejoin',
  'stroke-linecap',
  'opacity',
  'display',
  'font-family',
  'font-size',
  'font-weight',
  'text-anchor',
];
const INVISIBLE = 'rgba(0, 0, 0, 0)';

function svg_element(name, attributes, text = null) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== null) made.textContent = text;
  return made;
}

// A copy with the styles that the style sheet gives.
function styled_copy(original) {
  const copy = original.cloneNode(true);
  const [from, to] = [[original, ...original.querySelectorAll('*')], [copy, ...copy.querySelectorAll('*')]];
  from.forEach((one, i) => {
    const style = getComputedStyle(one);
    for (const name of ['class', 'style', 'tabindex', 'data-about']) to[i].removeAttribute(name);
    for (const name of STYLES) to[i].style.setProperty(name, style.getPropertyValue(name));
  });
  return copy;
}

const by_top = (a, b) => a.top - b.top;

// The lines of a text node: [{text, box}].
function lines_of(node) {
  const lines = [];
  const range = document.createRange();
  for (const word of node.data.matchAll(/\S+/g)) {
    range.setStart(node, word.index);
    range.setEnd(node, word.index + word[0].length);
    const box = range.getBoundingClientRect();
    const line = lines.find((one) => Math.abs(by_top(one.box, box)) < 2);
    if (line) line.text += ` ${word[0]}`;
    else if (box.width > 0) lines.push({text: word[0], box});
  }
  return lines;
}

function box_of(part, style, at, opacity = 1) {
  return svg_element('rect', {
    ...at,
    width: part.width,
    height: part.height,
    fill: style.backgroundColor,
    opacity: style.opacity * opacity,
  });
}

function borders_of(part, style, at) {
  return [
    ['Top', at.y],
    ['Bottom', at.y + part.height],
  ]
    .filter(([side]) => parseFloat(style[`border${side}Width`]) > 0 && style[`border${side}Style`] !== 'none')
    .map(([side, y]) =>
      svg_element('path', {
        d: `M${at.x},${y}h${part.width}`,
        stroke: style[`border${side}Color`],
        'stroke-width': parseFloat(style[`border${side}Width`]),
      })
    );
}

// Adds what an element shows, and what is in it, to `to`.
function add(to, node, origin) {
  if (node.nodeType === Node.TEXT_NODE) {
    const style = getComputedStyle(node.parentElement);
    for (const {text, box} of lines_of(node))
      to.append(
        svg_element(
          'text',
          {
            x: box.left - origin.left,
            y: box.top - origin.top + 0.78 * box.height,
            fill: style.color,
            style: `font: ${style.fontWeight} ${style.fontSize} ${style.fontFamily}`,
          },
          text
        )
      );
    return;
  }
  if (!(node instanceof Element) || node.matches('.visually-hidden, .figure-tools, [hidden]')) return;
  const part = node.getBoundingClientRect();
  if (part.width === 0) return;
  const at = {x: part.left - origin.left, y: part.top - origin.top};
  if (node instanceof SVGSVGElement) {
    const copy = styled_copy(node);
    for (const [key, value] of Object.entries({...at, width: part.width, height: part.height, overflow: 'visible'}))
      copy.setAttribute(key, value);
    to.append(copy);
    return;
  }
  const style = getComputedStyle(node);
  const before = getComputedStyle(node, '::before');
  if (style.backgroundColor !== INVISIBLE) to.append(box_of(part, style, at));
  if (before.content !== 'none' && before.backgroundColor !== INVISIBLE) to.append(box_of(part, before, at));
  if (node.matches('th, td')) to.append(...borders_of(part, style, at));
  for (const child of node.childNodes) add(to, child, origin);
}

// The text of an SVG file that shows `node` in the colours of the light theme.
export function svg_text(node) {
  const root = document.documentElement;
  const theme = root.dataset.theme;
  root.dataset.theme = 'light';
  const origin = node.getBoundingClientRect();
  const [width, height] = [Math.ceil(node.scrollWidth || origin.width), Math.ceil(origin.height)];
  const made = svg_element('svg', {viewBox: `0 0 ${width} ${height}`, width, height});
  made.append(svg_element('rect', {width, height, fill: '#ffffff'}));
  add(made, node, origin);
  root.dataset.theme = theme;
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(made)}\n`;
}

export function download(blob, name) {
  const link = element('a', {href: URL.createObjectURL(blob), download: name});
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Names of files have no spaces and no dots but the last.
export function file_name(words, ending) {
  return `${words.join('_').replace(/[^A-Za-z0-9-]+/g, '_').replace(/^_+|_+$/g, '')}.${ending}`;
}

export function save_svg(node, words) {
  download(new Blob([svg_text(node)], {type: 'image/svg+xml'}), file_name(words, 'svg'));
}

// Adds the button that saves a figure; its file is named after its section and `title`.
export function with_svg_button(node, title) {
  const save = () => save_svg(node, [node.closest('section').id, title].filter(Boolean));
  const about = {type: 'button', class: 'button small', title: 'save this figure as SVG', onclick: save};
  node.append(element('div', {class: 'figure-tools'}, element('button', about, 'SVG')));
  return node;
}
