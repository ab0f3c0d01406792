// SPDX-License-Identifier: MIT
// The calculations of the report's page, without a browser: report_logic.cjs PAGE_FOLDER.
'use strict';
const assert = require('node:assert');
const {page_modules} = require('./page_modules.cjs');

const {
  numbers,
  ranking,
  labels,
  verdict,
  answer,
  failures,
  graded_tests,
  table_model,
  trial_points,
  comparisons,
  faults,
  metrics_table,
  provenance,
  heat_map,
  threshold_curves,
} = page_modules(process.argv[2], {
  numbers: 'numbers.js',
  ranking: 'ranking.js',
  labels: 'labels.js',
  verdict: 'run/verdict.js',
  answer: 'run/answer.js',
  failures: 'run/failures.js',
  graded_tests: 'tables/graded_tests.js',
  table_model: 'tables/table_model.js',
  trial_points: 'plots/trial_points.js',
  comparisons: 'tables/comparisons.js',
  faults: 'run/faults.js',
  metrics_table: 'tables/metrics_table.js',
  provenance: 'run/provenance.js',
  heat_map: 'tables/heat_map.js',
  threshold_curves: 'plots/threshold_curves.js',
});

const plain = (value) => JSON.parse(JSON.stringify(value));
const same = (found, expected) => assert.deepStrictEqual(plain(found), expected);

// two scenarios, two planners, two controllers, two trials each; the last of office's is undefined
function sample() {
  const combinations = [];
  for (const scenario of ['mall', 'office'])
    for (const global_planner of ['P', 'Q'])
      for (const local_controller of ['c', 'd'])
        combinations.push({scenario, robots: 2, global_planner, local_controller, pedestrian_model: 'm'});
  const summary = (mean) => ({
    defined: mean === null ? 0 : 2,
    mean,
    low: mean,
    high: mean,
    sd: 0,
    median: mean,
    paper_mean: mean,
    paper_count: 2,
    paper_trimmed_all_nonzero: false,
  });
  const trials = {
    id: [],
    combination: [],
    repetition: [],
    seed: [],
    outcome: [],
    repeatable: [],
    sim_time_s: [],
    wall_time_s: [],
  };
  combinations.forEach((_, c) =>
    [0, 1].forEach((repetition) => {
      const row = {
        id: trials.id.length,
        combination: c,
        repetition,
        seed: String(repetition),
        outcome: 'succeeded',
        repeatable: true,
        sim_time_s: 10,
        wall_time_s: 1,
      };
      for (const key of Object.keys(trials)) trials[key].push(row[key]);
    })
  );
  const times = [5, 3, 4, 3, 9, 8, 7, null];
  const arrived = [1, 0.5, 1, 1, 1, 1, 1, 1];
  const planners = [
    ['mall', 'P'],
    ['mall', 'Q'],
    ['office', 'P'],
    ['office', 'Q'],
  ].map(([scenario, global_planner]) => ({scenario, robots: 2, global_planner}));
  return {
    best: [
      {...combinations[1], metric: 'time'},
      {scenario: 'office', robots: 2, global_planner: 'P', local_controller: '', pedestrian_model: '', metric: 'time'},
    ],
    failures_line: '',
    standstills_line: '',
    failures: [],
    answers: [],
    replays: [],
    run: {trials_planned: 16},
    faults: [],
    timing: [],
    combinations,
    trials,
    scenarios: ['mall', 'office'].map((name) => ({name, robots: 2, people: 3, title: name, description: ''})),
    metrics: [
      {name: 'arrived', unit: '1', direction: 'higher', description: 'share'},
      {name: 'time', unit: 's', direction: 'lower', description: 'how long'},
    ],
    values: {arrived: trials.combination.map((c) => arrived[c]), time: trials.combination.map((c) => times[c])},
    summaries: combinations.map((_, c) => [summary(arrived[c]), summary(times[c])]),
    planners,
    planner_summaries: planners.map((_, p) => [summary(1), summary(p)]),
    layouts: {
      summary: {arrived: 'arrived', contacts: 'contacts'},
      report: {
        tables: [
          {
            id: 'plans',
            title: 'Plans',
            rows: ['global_planner'],
            across: ['scenario'],
            columns: [{metric: 'time', header: 'time', decimals: 1}],
          },
          {
            id: 'driving',
            title: 'Driving',
            rows: ['global_planner', 'local_controller', 'pedestrian_model'],
            columns: [
              {metric: 'time', header: 'time', decimals: 1, spread: 'arrived'},
              {metric: 'unknown', header: 'x', decimals: 1},
            ],
          },
        ],
      },
    },
  };
}

const tests = {
  'numbers have a minus sign, none for zero, and a dash if undefined'() {
    const n = numbers;
    same([n.fixed(-1.25, 1), n.fixed(-0.001, 2), n.fixed(null, 2), n.fixed(NaN, 2)], ['\u22121.3', '0.00', '—', '—']);
    same([n.signed(0.5, 1), n.signed(-0.5, 1), n.signed(0, 1)], ['+0.5', '\u22120.5', '0.0']);
    same(
      [
        n.decimals_of([1, 20]),
        n.decimals_of([0.25]),
        n.decimals_of([59.5]),
        n.decimals_of([0, null]),
        n.decimals_of([1e-9]),
      ],
      [0, 3, 1, 0, 6]
    );
    same([n.interval(1, 2, 1), n.interval(1, 1.01, 1), n.interval(null, 2, 1)], ['[1.0, 2.0]', '', '']);
    same([n.p_value(0.0004), n.p_value(0.25), n.p_value(null)], ['< 0.001', '0.250', '—']);
    same(
      [n.with_unit('3', 'm'), n.with_unit('3', '1'), n.counted(1, 'trial'), n.counted(2, 'person', 'people')],
      ['3\u00a0m', '3', '1 trial', '2 people']
    );
  },
  'undefined values come last in both orders, and the sort is stable'() {
    same(ranking.order([3, null, 1, 3], false), [2, 0, 3, 1]);
    same(ranking.order([3, null, 1, 3], true), [0, 3, 2, 1]);
    same(ranking.order(['a10', 'a9', 'b'], false), [1, 0, 2]);
  },
  'the goodness of values follows the direction'() {
    same(ranking.goodness([0, 5, 10, null], 'lower'), [1, 0.5, 0, null]);
    same(ranking.goodness([2, 2], 'higher'), [0.5, 0.5]);
  },
  'a table has a group for each scenario, with the marks of the host'() {
    const data = sample();
    const model = table_model.make(data, data.layouts.report.tables[1], labels.variants(data));
    same(
      model.columns.map((column) => column.metric.name),
      ['time']
    );
    same(
      model.groups.map((group) => group.rows.map((row) => row.name)),
      [
        ['P + c', 'P + d', 'Q + c', 'Q + d'],
        ['P + c', 'P + d', 'Q + c', 'Q + d'],
      ]
    );
    same(
      model.groups[0].rows.map((row) => row.cells[0].best),
      [false, true, false, false]
    );
    same(
      model.groups[1].rows.map((row) => row.cells[0].best),
      [false, false, false, false]
    );
    same(
      model.groups[0].rows.map((row) => row.cells[0].spread),
      [1, 0.5, 1, 1]
    );
    same(
      model.groups[1].rows.map((row) => [row.cells[0].defined, row.cells[0].trials]),
      [
        [2, 2],
        [2, 2],
        [2, 2],
        [0, 2],
      ]
    );
    same(table_model.order(model, 0, false), [
      [1, 3, 2, 0],
      [2, 1, 0, 3],
    ]);
    same(table_model.order(model, 'local_controller', true), [
      [1, 3, 0, 2],
      [1, 3, 0, 2],
    ]);
  },
  'a table across scenarios repeats its columns'() {
    const data = sample();
    const model = table_model.make(data, data.layouts.report.tables[0], labels.variants(data));
    same(model.spans, [
      {title: 'mall · 2 robots', count: 1},
      {title: 'office · 2 robots', count: 1},
    ]);
    same(
      model.groups[0].rows.map((row) => [row.name, row.cells.map((cell) => [cell.mean, cell.trials])]),
      [
        [
          'P',
          [
            [0, 4],
            [2, 4],
          ],
        ],
        [
          'Q',
          [
            [1, 4],
            [3, 4],
          ],
        ],
      ]
    );
  },
  'a column that is the same in all rows leaves the table, and is told'() {
    const data = sample();
    const [layout] = data.layouts.report.tables;
    layout.columns.unshift({metric: 'arrived', header: 'arrived', decimals: 2});
    const [mall, office] = labels.variants(data);
    const whole = table_model.make(data, layout, [mall]);
    const {model, equal} = table_model.without_equal_columns(whole, 'success');
    same(equal, ['arrived 1.00']);
    same(
      model.columns.map((column) => column.header),
      ['time']
    );
    same(model.spans[0].count, 1);
    same(
      model.groups[0].rows.map((row) => row.cells.map((cell) => cell.mean)),
      [[0], [1]]
    );
    same(table_model.without_equal_columns(whole, 'arrived').model, whole);
    same(table_model.without_equal_columns(table_model.make(data, layout, [mall, office]), '').equal, []);
  },
  'a column of medians shows the median, without the interval of the mean'() {
    const data = sample();
    const [layout] = data.layouts.report.tables;
    layout.columns[0].median = true;
    data.planner_summaries[0][1] = {...data.planner_summaries[0][1], mean: 4.21, median: 0.14, low: 0.1, high: 9};
    const model = table_model.make(data, layout, labels.variants(data));
    const [cell] = model.groups[0].rows[0].cells;
    same([cell.mean, cell.low, cell.high], [0.14, null, null]);
  },
  'scenarios without robots have no rows'() {
    const data = sample();
    data.scenarios.push({name: 'mall', robots: 0, people: 3});
    data.combinations.push({
      scenario: 'mall',
      robots: 0,
      global_planner: '',
      local_controller: '',
      pedestrian_model: 'm',
    });
    data.planners.push({scenario: 'mall', robots: 0, global_planner: ''});
    data.planner_summaries.push(data.planner_summaries[0]);
    same(labels.variants(data).length, 2);
    same(labels.values_of(data, 'global_planner'), ['P', 'Q']);
    const model = table_model.make(data, data.layouts.report.tables[0], labels.variants(data));
    same(
      model.groups[0].rows.map((row) => row.name),
      ['P', 'Q']
    );
  },
  'sections open on the first metric that differs'() {
    const data = sample();
    data.layouts.report.heat_map = {metric: 'arrived'};
    same(heat_map.default_metric(data, data.metrics), 'arrived');
    for (const summaries of data.summaries) summaries[0].mean = 1;
    same(heat_map.default_metric(data, data.metrics), 'time');
    const one = (metric, p_holm, mean_difference, low = -1) => ({metric, p_holm, mean_difference, low, high: 3});
    data.comparisons = [one('a', 1, 0), one('b', 0.4, 1), one('d', 0.01, 2), one('c', 0.01, 2, 1)];
    same(comparisons.default_metric(data), 'c');
    data.comparisons.splice(2);
    same(comparisons.default_metric(data), 'b');
    data.comparisons.pop();
    same(comparisons.default_metric(data), 'a');
  },
  'a curve that does not depend on the controller is drawn once'() {
    const curve = (combination, y) => ({combination, points: [[0.5, y, y, y, 2]]});
    const stratum = {title: 'mall', combinations: [0, 1]};
    const drawn = (...curves) =>
      threshold_curves.panels_of([stratum], curves).map((one) => [one.stratum.title, one.curves.length]);
    same(drawn(curve(0, 1), curve(1, 2)), [['mall', 2]]);
    same(drawn(curve(0, 1), curve(1, 1)), [['mall · the same for all controllers', 1]]);
    same(drawn(curve(0, 0), curve(1, 0)), [['mall · the same for all controllers · 0 at every threshold', 1]]);
    same(drawn(curve(0, 0)), [['mall · 0 at every threshold', 1]]);
    same(drawn(curve(7, 1)), []);
  },
  'an answer says what it is about, and how each combination differs from the first'() {
    const data = sample();
    const cell = {scenario: 'mall', robots: 2, pedestrian_model: 'm'};
    const all = {cells: [cell, {...cell, scenario: 'office'}]};
    data.answers = [all, {cells: [cell]}];
    same([all, {cells: [cell]}].map((one) => answer.scope_words(data, one)), ['all', 'mall']);
    data.answers.push({cells: [{...cell, robots: 20}]});
    same(answer.scope_words(data, {cells: [cell]}), 'mall · 2 robots');
    const against = {n: 20, mean: -0.25, low: -0.4, high: -0.1, equal: false};
    same(answer.difference_words(against), '\u22120.25 [\u22120.40, \u22120.10]');
    same(answer.difference_words({...against, mean: 0, equal: true}), '=');
    same(answer.difference_words({...against, n: 0}), '—');
  },
  'a threshold opens the trials of its level, failed ones first'() {
    const result = {global_planner: 'P', local_controller: 'C', pedestrian_model: '', means: [0, 0.5, 1]};
    const series = {scenarios: ['door 0.6', 'door 0.7', 'door 0.8'], results: [result]};
    const data = {
      combinations: [
        {scenario: 'door 0.6', global_planner: 'P', local_controller: 'C', pedestrian_model: ''},
        {scenario: 'door 0.7', global_planner: 'P', local_controller: 'C', pedestrian_model: ''},
        {scenario: 'door 0.7', global_planner: 'P', local_controller: 'D', pedestrian_model: ''},
      ],
      trials: {
        id: [4, 5, 6, 7],
        combination: [0, 1, 1, 2],
        outcome: ['failed', 'succeeded', 'failed', 'failed'],
      },
    };
    assert.strictEqual(graded_tests.level_of_threshold(result), 1);
    assert.strictEqual(graded_tests.level_of_threshold({means: [0, null, 0.4]}), 2);
    same(graded_tests.trials_at(data, series, result, 1), [6, 5]);
    same(graded_tests.trials_at(data, series, result, 2), []);
  },

  'a count of failures opens a trial that the page can replay'() {
    const data = sample();
    const none = {cause: 'contact', robots: 0, trials: []};
    data.failures = [
      {combination: data.combinations[0], robots: 4, causes: [{cause: 'deadlock', robots: 1, trials: [3]}], contact: none},
      {
        combination: data.combinations[1],
        robots: 4,
        causes: [{cause: 'oscillation', robots: 2, trials: [4, 5]}],
        contact: {...none, robots: 1, trials: [6]},
      },
    ];
    data.replays = [{trial: 5}];
    same(failures.causes(data), ['oscillation', 'deadlock', 'contact']);
    assert.strictEqual(failures.count_words({robots: 9, roots: 2}), '9 (by 2 robots)');
    assert.strictEqual(failures.count_words({robots: 9, roots: 0}), '9');
    same(failures.trial_to_open(data, data.failures[1].causes[0]), {trial: 5, replayed: true});
    same(failures.trial_to_open(data, data.failures[0].causes[0]), {trial: 3, replayed: false});
  },
  'the verdict lists problems, the worst first'() {
    const data = sample();
    data.values.arrived = data.trials.id.map(() => 1);
    same(
      verdict.lines(data).map((line) => line.kind),
      ['good']
    );
    assert.match(verdict.lines(data)[0].text, /32 of 32 robots arrived/);
    data.values.contacts = data.trials.id.map((id) => (id === 5 ? 2 : 0));
    assert.match(verdict.lines(data)[0].text, /^32 of 32 robots arrived, with 2 contacts; no faults/);
    delete data.values.contacts;
    data.values.arrived[2] = 0.5;
    data.trials.outcome[2] = 'failed';
    data.failures_line = '1 did not arrive: 1 deadlock';
    same(
      verdict.lines(data).map((line) => line.text),
      ['1 robot of 32 did not arrive, in 1 trial: 1 deadlock.', '16 trials without a fault, every one repeatable.']
    );
    data.growth_line = 'You added trials.';
    same(verdict.lines(data)[0], {kind: 'warning', text: 'You added trials.', section: null});
    delete data.growth_line;
    data.failures = [{causes: [{cause: 'excluded for oscillation', robots: 1, trials: [2]}], contact: {robots: 0}}];
    assert.strictEqual(
      verdict.lines(data)[0].text,
      '32 of 32 robots arrived; 1 of them is excluded for oscillation.'
    );
    data.failures = [];
    data.standstills_line = 'Of 6 robots at standstills that ran on to the time limit, 1 arrived after all';
    assert.ok(verdict.lines(data).some((line) => line.text === `${data.standstills_line}.`));
    data.standstills_line = '';
    data.trials.repeatable[3] = false;
    data.run.trials_planned = 20;
    data.faults = [{trial: 4}, {trial: 4}];
    const lines = verdict.lines(data);
    same(
      lines.map((line) => line.kind),
      ['bad', 'bad', 'warning', 'note']
    );
    assert.match(lines[0].text, /^2 faults in 1 trial/);
    assert.match(lines[1].text, /^4 trials of 20 are missing/);
    assert.match(lines[2].text, /^1 trial is not repeatable bit by bit: a wall-clock limit/);
    data.timing = [1, 2].map((trial) => ({trial, plugin: 'a.b', reason: 'draws in a thread'}));
    assert.match(verdict.lines(data)[2].text, /bit by bit: a\.b: draws in a thread\.$/);
    data.values.arrived = data.trials.id.map(() => 0);
    assert.ok(verdict.lines(data).some((line) => line.text.startsWith('No robot arrived: all 32 failed')));
  },
  'points are spread by their trial alone, evenly enough'() {
    const spread = Array.from({length: 1000}, (_, id) => trial_points.jitter(id));
    assert.ok(spread.every((value) => value >= -1 && value < 1));
    assert.ok(Math.abs(spread.reduce((sum, value) => sum + value, 0) / 1000) < 0.1);
    assert.ok(new Set(spread).size > 990);
    same(trial_points.jitter(17), trial_points.jitter(17));
  },
  'arrow keys reach the next point of a row, and the next row'() {
    const points = [
      {x: 0, y: 0},
      {x: 10, y: 0},
      {x: 9, y: 20},
      {x: 30, y: 0},
    ];
    const next = (from, key) => trial_points.neighbour(points, from, key);
    same([next(-1, 'ArrowRight'), next(0, 'ArrowRight'), next(1, 'ArrowRight'), next(3, 'ArrowRight')], [0, 1, 3, 3]);
    same([next(1, 'ArrowLeft'), next(1, 'ArrowDown'), next(2, 'ArrowUp'), next(0, 'ArrowUp')], [0, 2, 1, 0]);
  },
  'a difference has the estimate of its test'() {
    const comparison = {median_difference: 1, low: 0, high: 2, mean_difference: 5, mean_low: 4, mean_high: 6};
    same(comparisons.estimate_of({...comparison, test: 'signed_rank'}), {estimate: 1, low: 0, high: 2});
    same(comparisons.estimate_of({...comparison, test: 'mean'}), {estimate: 5, low: 4, high: 6});
  },
  'faults are grouped by kind, plugin and function'() {
    const fault = (trial, kind, plugin) => ({trial, kind, plugin, function: 'step'});
    const all = [fault(0, 'crash', 'a'), fault(1, 'hang', 'b'), fault(2, 'crash', 'a'), fault(3, 'crash', 'b')];
    same(
      faults.groups(all).map((group) => group.map((one) => one.trial)),
      [[0, 2], [1], [3]]
    );
    assert.strictEqual(faults.count_words(all), '3 crash, 1 hang');
  },

  'the search finds metrics that contain all words'() {
    const data = sample();
    same(metrics_table.found(data, ''), [0, 1]);
    same(metrics_table.found(data, 'HOW time'), [1]);
    same(metrics_table.found(data, 'how share'), []);
  },
  'the command line can be pasted into a shell'() {
    const grown = {command_line: ['dmrp-host', 'a.toml', '--trials', '4', '--jobs=2'], repetitions: 20};
    same(provenance.whole_run(grown), grown.command_line);
    grown.manifest = {experiment: {grown_from: [4]}};
    same(provenance.whole_run(grown), ['dmrp-host', 'a.toml', '--jobs=2', '--trials', '20']);
    same(provenance.command_words(['dmrp-host', 'my run.toml', "it's"]), "dmrp-host 'my run.toml' 'it'\\''s'");
  },
  'a heat map has a cell for each pair'() {
    const grids = heat_map.grids(sample(), 'time');
    same(
      grids.map((grid) => [grid.title, grid.cells.map((row) => row.map((cell) => cell.mean))]),
      [
        [
          'mall · 2 robots',
          [
            [5, 3],
            [4, 3],
          ],
        ],
        [
          'office · 2 robots',
          [
            [9, 8],
            [7, null],
          ],
        ],
      ]
    );
  },
};

let failed = 0;
for (const [name, run] of Object.entries(tests)) {
  try {
    run();
  } catch (error) {
    ++failed;
    console.error(`FAILED: ${name}\n${error.stack}`);
  }
}
console.log(`${Object.keys(tests).length - failed} of ${Object.keys(tests).length} passed`);
process.exit(failed > 0 ? 1 : 0);
