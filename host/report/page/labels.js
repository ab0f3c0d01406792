// SPDX-License-Identifier: MIT
// labels.js: what combinations, scenarios and metrics are called, and which colour and shape stands for which.
import * as numbers from './numbers.js';
import * as ranking from './ranking.js';

const FIELDS = ['global_planner', 'local_controller', 'pedestrian_model'];
export const FIELD_TITLES = {
  global_planner: 'global planner',
  local_controller: 'local controller',
  pedestrian_model: 'pedestrian model',
};
export const SHORT_TITLES = {
  global_planner: 'planner',
  local_controller: 'controller',
  pedestrian_model: 'pedestrians',
};
const DASHES = ['none', '7 4', '2 3', '9 3 2 3']; // so that lines on top of each other are both seen
const SERIES = 8; // colours in base.css, each with a shape and a dash of its own

export function distinct(values) {
  return [...new Set(values)];
}

// Scenario and number of robots: what combinations are compared within. `combinations`: their indices. Worlds without
// robots are left out where there are others: they are there to be compared with.
export function variants(data) {
  const with_robots = data.scenarios.filter((scenario) => scenario.robots > 0);
  return (with_robots.length > 0 ? with_robots : data.scenarios).map((scenario) => ({
    scenario,
    key: `${scenario.name}/${scenario.robots}`,
    label: `${scenario.name} · ${numbers.counted(scenario.robots, 'robot')}`,
    combinations: data.combinations
      .map((combination, i) => (is_of(scenario, combination) ? i : -1))
      .filter((i) => i >= 0),
  }));
}

// Whether a row of any kind is about this scenario and number of robots.
export function is_of(scenario, row) {
  return row.scenario === scenario.name && row.robots === scenario.robots;
}

// Worlds without robots have no planner and no controller.
export function values_of(data, field) {
  const with_robots = data.combinations.filter((combination) => combination.robots > 0);
  return distinct((with_robots.length > 0 ? with_robots : data.combinations).map((combination) => combination[field]));
}

// The fields that tell combinations apart; pedestrian models only where there are several.
export function naming_fields(data) {
  return FIELDS.filter((field) => field !== 'pedestrian_model' || values_of(data, field).length > 1);
}

// What correlations and curves are kept apart by: variant, planner, pedestrian model.
export function strata(data) {
  const several = (field) => values_of(data, field).length > 1;
  return variants(data).flatMap((variant) => {
    const key = (i) => JSON.stringify([data.combinations[i].global_planner, data.combinations[i].pedestrian_model]);
    return distinct(variant.combinations.map(key)).map((one) => {
      const combinations = variant.combinations.filter((i) => key(i) === one);
      const {global_planner, pedestrian_model} = data.combinations[combinations[0]];
      const title = [
        variant.label,
        several('global_planner') && global_planner,
        several('pedestrian_model') && named(pedestrian_model),
      ]
        .filter(Boolean)
        .join(' · ');
      return {variant, global_planner, pedestrian_model, combinations, title};
    });
  });
}

// Labels are empty where nobody plans, drives or walks.
export function named(label) {
  return label === '' ? 'none' : label;
}

export function combination(data, index, fields = naming_fields(data)) {
  return fields.map((field) => named(data.combinations[index][field])).join(' + ');
}

export function trial(data, row) {
  const of = data.combinations[data.trials.combination[row]];
  return `trial ${data.trials.id[row]} · ${of.scenario} · ${combination(data, data.trials.combination[row])}`;
}

export function metric(data, name) {
  return data.metrics.find((candidate) => candidate.name === name);
}

// "completion time", "IBTR by distance": abbreviations as the layouts write them.
export function metric_title(data, name) {
  const headers = data.layouts.report.tables.flatMap((table) => table.columns.map((column) => column.header));
  const written = new Map(
    headers.filter((header) => header === header.toUpperCase()).map((header) => [header.toLowerCase(), header])
  );
  return name
    .split('_')
    .map((word) => written.get(word) || word)
    .join(' ');
}

export function metric_unit(data, name) {
  return numbers.unit((metric(data, name) || {unit: ''}).unit);
}

export function metric_with_unit(data, name) {
  const unit = metric_unit(data, name);
  return metric_title(data, name) + (unit ? ` (${unit})` : '');
}

export function direction_words(direction) {
  return {higher: 'higher is better', lower: 'lower is better', none: 'neither is better'}[direction];
}

// Metrics with a value in at least one trial, as they were declared.
export function measured_metrics(data) {
  return data.metrics.filter((candidate) => (data.values[candidate.name] || []).some(ranking.is_defined));
}

// Decimals that a layout gives a metric; else by its values.
export function decimals(data, name, values) {
  const columns = data.layouts.report.tables.flatMap((table) => table.columns);
  const written = columns.find((column) => column.metric === name);
  return written ? written.decimals : numbers.decimals_of(values);
}

// Which colour, symbol and dash a label has among its kind: the same in every plot.
export function series(data, field, label) {
  const index = values_of(data, field).indexOf(label);
  return {
    index,
    colour: `var(--series-${(index % SERIES) + 1})`,
    symbol: index % 7,
    dash: DASHES[index % DASHES.length],
  };
}
