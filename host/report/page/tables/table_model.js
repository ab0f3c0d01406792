// SPDX-License-Identifier: MIT
// table_model.js: the content of a result table: columns, groups of rows, the best of each column, the order of rows.
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import * as ranking from '../ranking.js';

// The rows of a table. Rows by planner alone summarise all controllers and pedestrian models.
function source(data, layout) {
  const by_planner = layout.rows.length === 1 && layout.rows[0] === 'global_planner';
  const rows = by_planner ? data.planners : data.combinations;
  const fields = ['scenario', 'robots', 'global_planner'].concat(
    by_planner ? [] : ['local_controller', 'pedestrian_model']
  );
  const key = (row) => JSON.stringify(fields.map((field) => row[field]));
  const trials = new Map(rows.map((row) => [key(row), 0]));
  data.trials.combination.forEach((combination, i) => {
    const of = key(data.combinations[combination]);
    if (!['skipped', 'unsupported'].includes(data.trials.outcome[i])) trials.set(of, trials.get(of) + 1);
  });
  return {
    rows,
    by_planner,
    summaries: by_planner ? data.planner_summaries : data.summaries,
    trials: rows.map((row) => trials.get(key(row))),
  };
}

// The layout's columns whose metrics the run has: [{metric, index, header, decimals, median, spread_index, variant}].
function columns_of(data, layout, variant) {
  const index_of = (name) => data.metrics.findIndex((metric) => metric.name === name);
  return layout.columns
    .filter((column) => index_of(column.metric) >= 0)
    .map((column) => ({
      metric: data.metrics[index_of(column.metric)],
      index: index_of(column.metric),
      header: column.header,
      decimals: column.decimals,
      median: column.median === true,
      spread_index: column.spread ? index_of(column.spread) : -1,
      variant,
    }));
}

function fields_of(data, layout) {
  const naming = labels.naming_fields(data);
  return layout.rows.filter((field) => naming.includes(field));
}

function label_of(row, fields) {
  return fields.map((field) => labels.named(row[field])).join(' + ');
}

function cell_of(data, from, row, column) {
  const summary = from.summaries[row][column.index];
  const spread = column.spread_index >= 0 ? from.summaries[row][column.spread_index].mean : null;
  const best = ranking.is_best(data, from.rows[row], column.metric.name);
  const shown = column.median ? {...summary, mean: summary.median, low: null, high: null} : summary;
  return {...shown, spread, trials: from.trials[row], best};
}

// One group of rows for each variant, as in Table III of the paper.
function grouped(data, layout, variants) {
  const from = source(data, layout);
  const {rows, by_planner} = from;
  const fields = fields_of(data, layout);
  const columns = columns_of(data, layout, null);
  const groups = variants.map((variant) => ({
    title: variant.label,
    rows: rows
      .map((row, i) => i)
      .filter((i) => labels.is_of(variant.scenario, rows[i]))
      .map((i) => ({
        labels: rows[i],
        name: label_of(rows[i], fields),
        combination: by_planner ? null : i,
        cells: columns.map((column) => cell_of(data, from, i, column)),
      })),
  }));
  return {fields, columns, groups, spans: []};
}

// The columns repeated for each variant, as in Table II of the paper; a cell is null if the row has no such variant.
function across(data, layout, variants) {
  const from = source(data, layout);
  const {rows} = from;
  const fields = fields_of(data, layout);
  const columns = variants.flatMap((variant) => columns_of(data, layout, variant));
  const shown = rows.filter((row) => variants.some((variant) => labels.is_of(variant.scenario, row)));
  const names = labels.distinct(shown.map((row) => label_of(row, fields)));
  const found = (name, variant) =>
    rows.findIndex((row) => label_of(row, fields) === name && labels.is_of(variant.scenario, row));
  const table_rows = names.map((name) => ({
    labels: rows.find((row) => label_of(row, fields) === name),
    name,
    combination: null,
    cells: columns.map((column) => {
      const row = found(name, column.variant);
      return row < 0 ? null : cell_of(data, from, row, column);
    }),
  }));
  const per_variant = variants.length === 0 ? 0 : columns.length / variants.length;
  return {
    fields,
    columns,
    groups: [{title: null, rows: table_rows}],
    spans: variants.map((variant) => ({title: variant.label, count: per_variant})),
  };
}

// Columns that are the same in every row tell nothing apart: they leave the table. `kept`: the metric that stays.
// Returns the rest, and what left in words: "overlap of bodies 0.000".
export function without_equal_columns(model, kept) {
  const rows = model.groups.flatMap((group) => group.rows);
  const value = (cell) => JSON.stringify(cell && [cell.mean, cell.low, cell.high, cell.spread]);
  const is_equal = (c) =>
    model.columns[c].metric.name !== kept &&
    rows.every((row) => row.cells[c] && ranking.is_defined(row.cells[c].mean)) &&
    rows.every((row) => value(row.cells[c]) === value(rows[0].cells[c]));
  const columns = model.columns.map((_, c) => c).filter((c) => !is_equal(c));
  if (rows.length < 2 || model.spans.length > 1 || columns.length === 0) return {model, equal: []};
  const equal = model.columns.map((_, c) => c).filter((c) => is_equal(c));
  const picked = (list) => columns.map((c) => list[c]);
  return {
    model: {
      ...model,
      columns: picked(model.columns),
      spans: model.spans.map((span) => ({...span, count: columns.length})),
      groups: model.groups.map((group) => ({
        ...group,
        rows: group.rows.map((row) => ({...row, cells: picked(row.cells)})),
      })),
    },
    equal: equal.map((c) => {
      const {header, decimals, metric} = model.columns[c];
      return `${header} ${numbers.with_unit(numbers.fixed(rows[0].cells[c].mean, decimals), metric.unit)}`;
    }),
  };
}

function mean(cell) {
  return cell === null ? null : cell.mean;
}

export function make(data, layout, variants) {
  return (layout.across || []).includes('scenario')
    ? across(data, layout, variants)
    : grouped(data, layout, variants);
}

// The sorted indices of the rows of each group. key: the name of a field or the index of a column.
export function order(model, key, descending) {
  const value = (row) => (typeof key === 'number' ? mean(row.cells[key]) : row.labels[key]);
  return model.groups.map((group) => ranking.order(group.rows.map(value), descending));
}
