// SPDX-License-Identifier: MIT
// result_tables.js: the result tables that the layout defines; their headers sort them.
import * as controls from '../controls.js';
import {element, fill, group_row, hidden} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as ranking from '../ranking.js';
import {titled_table} from '../scroll_box.js';
import {explained_mark} from '../tips.js';
import * as metrics_table from './metrics_table.js';
import * as table_model from './table_model.js';

function defined_words(cell) {
  return `defined in ${cell.defined} of ${numbers.counted(cell.trials, 'trial')}`;
}

function paper_line(cell, column) {
  const text = ranking.is_defined(cell.paper_mean)
    ? numbers.fixed(cell.paper_mean, column.decimals)
    : numbers.UNDEFINED;
  return element(
    'span',
    {class: 'paper'},
    `${text} (${cell.paper_count})`,
    cell.paper_trimmed_all_nonzero &&
      explained_mark('†', 'the rule removed every value that is not zero', {class: 'flag'})
  );
}

function cell_element(cell, column) {
  if (cell === null) return element('td', {class: 'number'});
  const defined = ranking.is_defined(cell.mean);
  const partly = cell.defined < cell.trials;
  return element(
    'td',
    {class: cell.best ? 'number best' : 'number', 'data-about': partly || !defined ? defined_words(cell) : null},
    element(
      'span',
      {class: 'mean'},
      cell.best && hidden('best: '),
      numbers.fixed(cell.mean, column.decimals),
      ranking.is_defined(cell.spread) &&
        element('span', {class: 'spread'}, ` ±${numbers.fixed(cell.spread, column.decimals)}`)
    ),
    element(
      'span',
      {class: 'interval'},
      numbers.none_of(cell) || numbers.interval(cell.low, cell.high, column.decimals),
      partly && element('span', {class: 'partly'}, ` ${cell.defined}/${cell.trials}`)
    ),
    paper_line(cell, column)
  );
}

function row_element(row, columns) {
  const name =
    row.combination === null
      ? row.name
      : element(
          'a',
          {
            href: '#metrics',
            title: 'all metrics of this combination',
            onclick: () => metrics_table.show(row.combination),
          },
          row.name
        );
  return element(
    'tr',
    {},
    element('th', {scope: 'row'}, name),
    row.cells.map((cell, c) => cell_element(cell, columns[c]))
  );
}

function field_buttons(model, sort_by) {
  return element(
    'th',
    {scope: 'col', class: 'names', 'data-key': 'names'},
    model.fields.map((field, i) => [
      i > 0 && ' + ',
      element(
        'button',
        {type: 'button', class: 'sort', 'data-sort': field, onclick: () => sort_by(field)},
        labels.SHORT_TITLES[field]
      ),
    ])
  );
}

function unit_words(column) {
  const words = [numbers.unit(column.metric.unit), column.median && 'median'].filter(Boolean);
  return words.join(', ') || '\u2013';
}

function column_button(column, c, starts, sort_by) {
  const about = `${column.metric.description} (${labels.direction_words(column.metric.direction)})`;
  return element(
    'th',
    {scope: 'col', class: starts ? 'number starts' : 'number', 'data-key': c, 'aria-sort': 'none'},
    element(
      'button',
      {type: 'button', class: 'sort', 'data-sort': c, 'data-about': about, onclick: () => sort_by(c)},
      element('span', {class: 'header'}, column.header),
      element('span', {class: 'unit'}, unit_words(column))
    )
  );
}

function head(model, sort_by) {
  const made = element('thead');
  const per_span = model.spans.length ? model.spans[0].count : 0;
  if (model.spans.length > 0) {
    made.append(
      element(
        'tr',
        {class: 'spans'},
        element('td'),
        model.spans.map((span) => element('th', {scope: 'colgroup', colspan: span.count}, span.title))
      )
    );
  }
  made.append(
    element(
      'tr',
      {},
      field_buttons(model, sort_by),
      model.columns.map((column, c) => column_button(column, c, per_span > 0 && c % per_span === 0, sort_by))
    )
  );
  return made;
}

function show_sorting(table, key, descending) {
  const word = descending ? 'descending' : 'ascending';
  for (const header of table.querySelectorAll('thead th[data-key]')) {
    const button = [...header.querySelectorAll('.sort')].find((one) => one.dataset.sort === String(key));
    header.setAttribute('aria-sort', button ? word : 'none');
    for (const one of header.querySelectorAll('.sort')) one.classList.toggle('sorted', one === button);
  }
}

// Sorting moves the existing rows.
function sorter(table, model, bodies) {
  let sorted_key = null;
  let descending = false;
  return (key) => {
    const first = typeof key === 'number' && ranking.descending_first(model.columns[key].metric.direction);
    descending = key === sorted_key ? !descending : first;
    sorted_key = key;
    table_model.order(model, key, descending).forEach((order, g) => {
      for (const index of order) bodies[g].body.append(bodies[g].rows[index]);
    });
    show_sorting(table, key, descending);
  };
}

const MOST_COLUMNS = 9; // that fit beside each other on a laptop
const MOST_COLUMNS_PHONE = 3;

// A table with the scenarios beside each other where they fit, all of them whichever is chosen; else below each other.
function arranged(layout, all, chosen) {
  const most = window.innerWidth > 760 ? MOST_COLUMNS : MOST_COLUMNS_PHONE;
  const is_across = (layout.across || []).length > 0 && all.length * layout.columns.length <= most;
  return is_across ? {layout, variants: all} : {layout: {...layout, across: []}, variants: chosen};
}

// "IBTR: inter-robot blocking time ratio": the abbreviations in a table's heads.
function legend_words(data, model) {
  const headers = new Set(model.columns.map((column) => column.header));
  const spelled = data.layouts.summary.columns.filter(({header, legend}) => legend && headers.has(header));
  return spelled.map(({header, legend}) => `${header}: ${legend.replace(/,? on cells of .*/, '')}`).join(' · ');
}

function table_element(data, {layout, variants}) {
  const whole = table_model.make(data, layout, variants);
  const {model, equal} = table_model.without_equal_columns(whole, data.layouts.summary.arrived);
  if (model.columns.length === 0) return null;
  const table = element('table', {class: 'results', id: `table-${layout.id}`});
  const bodies = model.groups
    .filter((group) => group.rows.length > 0)
    .map((group) => {
      const rows = group.rows.map((row) => row_element(row, model.columns));
      const title = group.title && data.scenarios.length > 1 && group_row(group.title, model.columns.length + 1);
      return {rows, body: element('tbody', {}, title, rows)};
    });
  table.append(
    head(model, (key) => sort(key)),
    ...bodies.map((one) => one.body)
  );
  const sort = sorter(table, model, bodies);
  const notes = [
    layout.note,
    labels.population(data),
    equal.length > 0 && `The same in all rows: ${equal.join(', ')}.`,
  ];
  const titled = titled_table(`title-${layout.id}`, layout.title, notes.filter(Boolean).join(' '), table);
  const legend = legend_words(data, model);
  if (legend) titled.append(element('p', {class: 'note legend-line'}, legend));
  return titled;
}

const key_of = (data) =>
  'Dot and bold: with 95 % confidence better than all others of the column within a scenario; for values of driving only ' +
  `where all rows have the same success. Means are over ${data.observation}s. Brackets: 95 % interval ` +
  'over them, omitted if all trials agree to the digits shown. \u201c0 of 20: at most 14 %\u201d: none had any, and of all ' +
  'so many may (rule of three, 95 %). A fraction: the number of trials in which the value is ' +
  'defined. Paired differences tests the differences between rows. Click a header to sort.';
const PAPER_KEY =
  'Third line: the mean by the paper\u2019s rule, with the number of trials in parentheses: it excludes failed ' +
  'trials (except for metrics that count failures) and values beyond two standard deviations. † the rule removed every ' +
  'value that is not zero.';

// The reason why there is nothing to show, or null.
export function absent(data) {
  return data.combinations.length > 0 ? null : 'no trial was run';
}

export function mount(body, data) {
  const variants = labels.variants(data);
  const holder = element('div', {class: 'tables with-intervals'});
  const show = (key) =>
    fill(
      holder,
      data.layouts.report.tables.map((layout) =>
        table_element(data, arranged(layout, variants, variants.filter((one) => key === 'all' || one.key === key)))
      )
    );
  const paper_key = element('p', {class: 'note', hidden: true}, PAPER_KEY);
  const first = controls.first_variant(variants, data.combinations.length);
  show(first);
  fill(
    body,
    controls.row(
      controls.variant_select(variants, first, show),
      controls.checkbox('95 % intervals', true, (on) => holder.classList.toggle('with-intervals', on)),
      controls.checkbox('the paper\u2019s rule', false, (on) => {
        holder.classList.toggle('with-paper', on);
        paper_key.hidden = !on;
      })
    ),
    holder,
    element('p', {class: 'note'}, key_of(data)),
    paper_key
  );
}
