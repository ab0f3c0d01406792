// SPDX-License-Identifier: MIT
// controls.js: selects, buttons, checkboxes and search fields.
import {element} from './elements.js';
import * as labels from './labels.js';

export function row(...controls) {
  return element('div', {class: 'controls'}, controls);
}

// options: [{value, label}]. Calls `changed` with each new value. Null if there are fewer than two options.
export function select(title, options, value, changed) {
  if (options.length < 2) return null;
  const box = element('select', {onchange: () => changed(box.value)});
  for (const option of options)
    box.append(element('option', {value: option.value, selected: option.value === value}, option.label));
  return element('label', {class: 'control'}, element('span', {}, title), box);
}

export function metric_select(data, title, metrics, value, changed) {
  const options = metrics.map((metric) => ({
    value: metric.name,
    label: labels.metric_with_unit(data, metric.name),
  }));
  return select(title, options, value, changed);
}

const MOST_LETTERS = 32; // in a row of buttons; more do not fit on a telephone

// A row of buttons, one of them pressed, or a select where they would be too wide; the contract is that of select.
export function segmented(title, options, value, changed) {
  if (options.length < 2) return null;
  if (options.map((option) => option.label).join('').length > MOST_LETTERS)
    return select(title, options, value, changed);
  const buttons = options.map((option) =>
    element('button', {type: 'button', class: 'button', 'aria-pressed': String(option.value === value)}, option.label)
  );
  buttons.forEach((button, i) =>
    button.addEventListener('click', () => {
      buttons.forEach((one) => one.setAttribute('aria-pressed', String(one === button)));
      changed(options[i].value);
    })
  );
  return element(
    'div',
    {class: 'control', role: 'group', 'aria-label': title},
    element('span', {}, title),
    element('span', {class: 'segmented'}, buttons)
  );
}

// The first choice: all scenarios, or the first alone where there are more rows than fit on a screen.
export function first_variant(variants, rows) {
  return rows > 24 && variants.length > 1 ? variants[0].key : 'all';
}

// The first option is "all". Labels give the number of robots only where variants differ in it.
export function variant_select(variants, value, changed) {
  const names = labels.distinct(variants.map((variant) => variant.scenario.name));
  const short = names.length === variants.length;
  const options = variants.map((variant) => ({
    value: variant.key,
    label: short ? variant.scenario.name : variant.label,
  }));
  if (options.length > 1) options.unshift({value: 'all', label: 'all'});
  return (short && options.length <= 6 ? segmented : select)('Scenario', options, value, changed);
}

export function checkbox(title, checked, changed) {
  const box = element('input', {type: 'checkbox', checked, onchange: () => changed(box.checked)});
  return element('label', {class: 'control check'}, box, element('span', {}, title));
}

export function search(title, changed) {
  const box = element('input', {
    type: 'search',
    placeholder: title,
    'aria-label': title,
    oninput: () => changed(box.value),
  });
  return element('label', {class: 'control'}, box);
}

// Browsers deny navigator.clipboard to some pages opened by file://.
function copy_by_selection(text) {
  const area = element('textarea', {class: 'visually-hidden', readonly: true});
  area.value = text;
  document.body.append(area);
  area.select();
  const copied = document.execCommand('copy');
  area.remove();
  return copied;
}

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch (refused) {
    return copy_by_selection(text);
  }
}

export function copy_button(text, what) {
  const button = element('button', {type: 'button', class: 'button small', 'aria-label': `copy ${what}`}, 'Copy');
  button.addEventListener('click', async () => {
    button.textContent = (await copy(text)) ? 'Copied' : 'Select and copy by hand';
    setTimeout(() => {
      button.textContent = 'Copy';
    }, 2000);
  });
  return button;
}
