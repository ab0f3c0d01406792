// SPDX-License-Identifier: MIT
// completion.js: when robots arrive, those that never do included.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';
  const element = (...all) => dmrp.elements.element(...all);

  // Somewhat after the last arrival, since nothing changes from there to the time limit.
  function last_of_interest(rows) {
    const last = Math.max(...rows.map((row) => row.steps[row.steps.length - 1][0]));
    return Math.min(1.15 * last, Math.max(...rows.map((row) => row.horizon_s)));
  }

  function draw_panel(data, rows, until, title, holder, width) {
    const {svg, x, y} = dmrp.small_plots.frame(
      holder,
      width,
      {
        x: (pixels) => d3.scaleLinear().domain([0, until]).range(pixels),
        y: (pixels) => d3.scaleLinear().domain([0, 1]).range(pixels),
      },
      {all: title, x: 'time (s)'},
      [0.5, 1]
    );
    const line = d3
      .line()
      .x((step) => x(step[0]))
      .y((step) => y(step[1]))
      .curve(d3.curveStepAfter);
    for (const row of rows) {
      const series = dmrp.labels.series(data, 'local_controller', data.combinations[row.combination].local_controller);
      const last = row.steps[row.steps.length - 1];
      svg
        .append('path')
        .attr('class', 'line')
        .style('stroke', series.colour)
        .style('stroke-dasharray', series.dash)
        .attr('d', line([[0, 0], ...row.steps, [until, last[1]]]));
      svg
        .append('path')
        .attr('class', 'mark')
        .style('fill', series.colour)
        .attr('d', dmrp.plots.symbol(series.symbol, 50))
        .attr('transform', `translate(${x(last[0]).toFixed(1)},${y(last[1]).toFixed(1)})`);
    }
  }

  function table(data, rows, variants) {
    const column = (text, unit) =>
      element(
        'th',
        {scope: 'col', class: 'number'},
        element('span', {class: 'header'}, text),
        element('span', {class: 'unit'}, unit)
      );
    const made = element(
      'table',
      {class: 'results with-intervals'},
      element(
        'thead',
        {},
        element(
          'tr',
          {},
          element('th', {scope: 'col'}, 'combination'),
          column('restricted mean', 's'),
          column('time limit', 's'),
          column('arrived', '%'),
          column('robots', '–')
        )
      )
    );
    for (const variant of variants) {
      const own = rows.filter((row) => variant.combinations.includes(row.combination));
      if (own.length === 0) continue;
      const best = dmrp.ranking.best(
        own.map((row) => row.restricted_mean_s),
        'lower',
        1
      );
      made.append(
        element(
          'tbody',
          {},
          data.scenarios.length > 1 &&
            element(
              'tr',
              {class: 'group'},
              element('th', {scope: 'rowgroup', colspan: 5}, element('span', {}, variant.label))
            ),
          own.map((row, i) =>
            element(
              'tr',
              {},
              element('th', {scope: 'row'}, dmrp.labels.combination(data, row.combination)),
              element(
                'td',
                {class: best.has(i) ? 'number best' : 'number'},
                element(
                  'span',
                  {class: 'mean'},
                  best.has(i) && dmrp.elements.hidden('best: '),
                  dmrp.numbers.fixed(row.restricted_mean_s, 1)
                ),
                element('span', {class: 'interval'}, dmrp.numbers.interval(row.low, row.high, 1))
              ),
              element('td', {class: 'number'}, dmrp.numbers.fixed(row.horizon_s, 0)),
              element('td', {class: 'number'}, dmrp.numbers.fixed(100 * row.arrived_share, 1)),
              element('td', {class: 'number'}, row.robots)
            )
          )
        )
      );
    }
    return dmrp.elements.titled_table(
      'title-completion',
      'Restricted mean time to arrive',
      'The mean over all robots, where one that has not arrived counts with the time limit; 95 % intervals over seeds.',
      made
    );
  }

  function show_variants(data, rows, variants, holder) {
    dmrp.elements.fill(holder);
    const keys = variants.map((variant) => variant.key);
    const seen = dmrp.labels
      .strata(data)
      .filter((stratum) => keys.includes(stratum.variant.key))
      .map((stratum) => ({
        stratum,
        rows: rows.filter((row) => stratum.combinations.includes(row.combination) && (row.steps || []).length > 0),
      }))
      .filter((one) => one.rows.length > 0);
    const draw = (one, plot, width) => {
      const until = last_of_interest(
        seen.filter((other) => other.stratum.variant === one.stratum.variant).flatMap((other) => other.rows)
      );
      draw_panel(data, one.rows, until, `Arrivals over time: ${one.stratum.title}`, plot, width);
    };
    if (seen.length > 0) dmrp.small_plots.panels(holder, 'share of robots that have arrived', seen, draw);
    holder.append(table(data, rows, variants));
  }

  function mount(body, data) {
    const rows = data.completion.filter((row) => dmrp.numbers.is_number(row.restricted_mean_s));
    if (rows.length === 0) return 'times of completion were not measured';
    const variants = dmrp.labels.variants(data);
    const first = dmrp.controls.first_variant(variants, rows.length);
    const holder = element('div');
    const show = (key) =>
      show_variants(
        data,
        rows,
        variants.filter((variant) => key === 'all' || variant.key === key),
        holder
      );
    dmrp.elements.fill(
      body,
      dmrp.controls.row(dmrp.controls.variant_select(variants, first, show)),
      dmrp.plots.field_legend(data, 'local_controller', true),
      holder
    );
    show(first);
    return null;
  }

  dmrp.completion = {mount};
})(window.dmrp);
