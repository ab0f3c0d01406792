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
  const SHORT_TITLES = {global_planner: 'planner', local_controller: 'controller', pedestrian_model: 'pedestrians'};
  const DASHES = ['none', '7 4', '2 3', '9 3 2 3']; // so that lines on top of each other are both seen
  const SERIES = 8; // colours in style.css, each with a shape and a dash of its own

  function distinct(values) {
    return [...new Set(values)];
  }

  // Scenario and number of robots: what combinations are compared within. `combinations`: their indices. Worlds without
  // robots are left out where there are others: they are there to be compared with.
  function variants(data) {
    const with_robots = data.scenarios.filter((scenario) => scenario.robots > 0);
    return (with_robots.length > 0 ? with_robots : data.scenarios).map((scenario) => ({
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

  // Worlds without robots have no planner and no controller.
  function values_of(data, field) {
    const with_robots = data.combinations.filter((combination) => combination.robots > 0);
    return distinct(
      (with_robots.length > 0 ? with_robots : data.combinations).map((combination) => combination[field])
    );
  }

  // The fields that tell combinations apart; pedestrian models only where there are several.
  function naming_fields(data) {
    return FIELDS.filter((field) => field !== 'pedestrian_model' || values_of(data, field).length > 1);
  }

  // What correlations and curves are kept apart by: variant, planner, pedestrian model.
  function strata(data) {
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
  function named(label) {
    return label === '' ? 'none' : label;
  }

  function combination(data, index, fields = naming_fields(data)) {
    return fields.map((field) => named(data.combinations[index][field])).join(' + ');
  }

  function trial(data, row) {
    const of = data.combinations[data.trials.combination[row]];
    return `trial ${data.trials.id[row]} · ${of.scenario} · ${combination(data, data.trials.combination[row])}`;
  }

  function metric(data, name) {
    return data.metrics.find((candidate) => candidate.name === name);
  }

  // "completion time", "IBTR by distance": abbreviations as the layouts write them.
  function metric_title(data, name) {
    const headers = data.layouts.report.tables.flatMap((table) => table.columns.map((column) => column.header));
    const written = new Map(
      headers.filter((header) => header === header.toUpperCase()).map((header) => [header.toLowerCase(), header])
    );
    return name
      .split('_')
      .map((word) => written.get(word) || word)
      .join(' ');
  }

  function metric_unit(data, name) {
    return dmrp.numbers.unit((metric(data, name) || {unit: ''}).unit);
  }

  function metric_with_unit(data, name) {
    const unit = metric_unit(data, name);
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
    return {
      index,
      colour: `var(--series-${(index % SERIES) + 1})`,
      symbol: index % 7,
      dash: DASHES[index % DASHES.length],
    };
  }

  dmrp.labels = {
    FIELD_TITLES,
    SHORT_TITLES,
    distinct,
    variants,
    strata,
    is_of,
    values_of,
    naming_fields,
    named,
    combination,
    trial,
    metric,
    metric_title,
    metric_unit,
    metric_with_unit,
    direction_words,
    measured_metrics,
    decimals,
    series,
  };
})(window.dmrp);
