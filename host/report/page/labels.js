// SPDX-License-Identifier: MIT
// labels.js: what combinations, scenarios and metrics are called, and which colour and shape stands for which.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';

  const FIELDS = ['global_planner', 'local_controller', 'pedestrian_model'];
  const FIELD_TITLES = {
    global_planner: 'global planner',
    local_controller: 'local controller',
    pedestrian_model: 'pedestrian model',
  };
  const SERIES = 8;  // colours in style.css, each with a shape and a dash of its own

  function distinct(values) {
    return [...new Set(values)];
  }

  // Scenario and number of robots: what combinations are compared within. `combinations`: their indices.
  function variants(data) {
    return data.scenarios.map((scenario) => ({
      scenario,
      key: `${scenario.name}/${scenario.robots}`,
      label: `${scenario.name} · ${dmrp.numbers.counted(scenario.robots, 'robot')}`,
      combinations: data.combinations
        .map((combination, i) => (is_of(scenario, combination) ? i : -1))
        .filter((i) => i >= 0),
    }));
  }

  // Whether a row of any kind is about this scenario and number of robots.
  function is_of(scenario, row) {
    return row.scenario === scenario.name && row.robots === scenario.robots;
  }

  function values_of(data, field) {
    return distinct(data.combinations.map((combination) => combination[field]));
  }

  // The fields that tell combinations apart; pedestrian models only where there are several.
  function naming_fields(data) {
    return FIELDS.filter((field) => field !== 'pedestrian_model' || values_of(data, field).length > 1);
  }

  function nobody(label) {
    return label === '' ? 'nobody' : label;
  }

  function combination(data, index, fields = naming_fields(data)) {
    return fields.map((field) => nobody(data.combinations[index][field])).join(' + ');
  }

  function trial(data, row) {
    const of = data.combinations[data.trials.combination[row]];
    return `trial ${data.trials.id[row]} · ${of.scenario} · ${combination(data, data.trials.combination[row])}`;
  }

  function metric(data, name) {
    return data.metrics.find((candidate) => candidate.name === name);
  }

  // "completion time"; an abbreviation as the layouts write it.
  function metric_title(data, name) {
    const columns = data.layouts.report.tables.flatMap((table) => table.columns);
    const written = columns.find((column) => column.header.toLowerCase() === name);
    return written ? written.header : name.replace(/_/g, ' ');
  }

  function metric_with_unit(data, name) {
    const unit = dmrp.numbers.unit((metric(data, name) || {unit: ''}).unit);
    return metric_title(data, name) + (unit ? ` (${unit})` : '');
  }

  function direction_words(direction) {
    return {higher: 'higher is better', lower: 'lower is better', none: 'neither is better'}[direction];
  }

  // Metrics with a value in at least one trial, as they were declared.
  function measured_metrics(data) {
    return data.metrics.filter((candidate) => (data.values[candidate.name] || []).some(dmrp.ranking.is_defined));
  }

  // Decimals that a layout gives a metric; else by its values.
  function decimals(data, name, values) {
    const columns = data.layouts.report.tables.flatMap((table) => table.columns);
    const written = columns.find((column) => column.metric === name);
    return written ? written.decimals : dmrp.numbers.decimals_of(values);
  }

  // Which colour, symbol and dash a label has among its kind: the same in every plot.
  function series(data, field, label) {
    const index = values_of(data, field).indexOf(label);
    return {index, colour: `var(--series-${(index % SERIES) + 1})`, symbol: index % 7};
  }

  dmrp.labels = {
    FIELD_TITLES, distinct, variants, is_of, values_of, naming_fields, nobody, combination, trial, metric, metric_title,
    metric_with_unit, direction_words, measured_metrics, decimals, series,
  };
})(window.dmrp);
