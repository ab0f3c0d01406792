// SPDX-License-Identifier: MIT
// labels.js: names of combinations, scenarios and metrics, and the colour and symbol of each label.
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
const DASHES = ['none', '7 4', '2 3', '9 3 2 3']; // so that coinciding lines stay visible
const SERIES = 8; // number of series colours in base.css

export function distinct(values) {
  return [...new Set(values)];
}

// What numbers of a run are about: the end of a table's caption.
export function population(data) {
  return `The trials: ${data.met}. Conditions: ${data.run.conditions}.`;
}

// A variant is a scenario with a number of robots; combinations are compared within a variant. `combinations`: their
// indices. Omits variants without robots, which serve as a reference, if there are others.
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

// Whether a row of any table belongs to this scenario and number of robots.
export function is_of(scenario, row) {
  return row.scenario === scenario.name && row.robots === scenario.robots;
}

// The distinct labels of a field; variants without robots have no planner and no controller.
export function values_of(data, field) {
  const with_robots = data.combinations.filter((combination) => combination.robots > 0);
  return distinct((with_robots.length > 0 ? with_robots : data.combinations).map((combination) => combination[field]));
}

// The fields that identify a combination; the pedestrian model only if there are several.
export function naming_fields(data) {
  return FIELDS.filter((field) => field !== 'pedestrian_model' || values_of(data, field).length > 1);
}

// Correlations and curves have one stratum for each variant, planner and pedestrian model.
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

// The label is empty if there is no planner, controller or pedestrian model.
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

// "completion time", "IBTR by distance": abbreviations are spelled as in the layouts.
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

// Metrics with a value in at least one trial, in the order of declaration.
export function measured_metrics(data) {
  return data.metrics.filter((candidate) => (data.values[candidate.name] || []).some(ranking.is_defined));
}

// The decimals of a metric: from the layout, else from its values.
export function decimals(data, name, values) {
  const columns = data.layouts.report.tables.flatMap((table) => table.columns);
  const written = columns.find((column) => column.metric === name);
  return written ? written.decimals : numbers.decimals_of(values);
}

// The colour, symbol and dash pattern of a label, the same in every plot.
export function series(data, field, label) {
  const index = values_of(data, field).indexOf(label);
  return {
    index,
    colour: `var(--series-${(index % SERIES) + 1})`,
    symbol: index % 7,
    dash: DASHES[index % DASHES.length],
  };
}
