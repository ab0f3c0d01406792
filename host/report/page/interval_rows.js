// SPDX-License-Identifier: MIT
// interval_rows.js: estimates with intervals, one under the other in a table's column. Drawn in percent of the column's
// width, so that they fit any screen and paper.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';
  const element = (...all) => dmrp.elements.element(...all);
  const HEIGHT = 22;

  // rows: [{estimate, low, high}]. A scale to percent that holds zero and every interval.
  function scale(rows) {
    const ends = rows.flatMap((row) => [row.estimate, row.low, row.high]).filter(dmrp.numbers.is_number);
    const [low, high] = d3.extent(ends.concat(0));
    const room = (high - low) * 0.05 || 1;
    return d3
      .scaleLinear()
      .domain([low - room, high + room])
      .range([2, 98]);
  }

  const percent = (at) => `${at.toFixed(2)}%`;

  function svg_of(holder, height) {
    return d3.select(holder).append('svg').attr('width', '100%').attr('height', height).attr('aria-hidden', 'true');
  }

  function add_zero(svg, x, height) {
    svg
      .append('line')
      .attr('class', 'zero')
      .attr('x1', percent(x(0)))
      .attr('x2', percent(x(0)))
      .attr('y1', 0)
      .attr('y2', height);
  }

  // Filled where `sure`.
  function cell(row, x, sure) {
    const holder = element('td', {class: 'interval-plot'});
    const svg = svg_of(holder, HEIGHT);
    const middle = HEIGHT / 2;
    add_zero(svg, x, HEIGHT);
    if (dmrp.numbers.is_number(row.low) && dmrp.numbers.is_number(row.high)) {
      svg
        .append('line')
        .attr('class', 'bar')
        .attr('x1', percent(x(row.low)))
        .attr('x2', percent(x(row.high)))
        .attr('y1', middle)
        .attr('y2', middle);
    }
    if (dmrp.numbers.is_number(row.estimate)) {
      svg
        .append('circle')
        .attr('class', sure ? 'estimate sure' : 'estimate')
        .attr('cx', percent(x(row.estimate)))
        .attr('cy', middle)
        .attr('r', 4.5);
    }
    return holder;
  }

  // The axis over the column: ticks, and what either side of zero means.
  function axis(x, left_words, right_words) {
    const holder = element('th', {class: 'interval-plot'});
    const svg = svg_of(holder, 36);
    const ticks = x.ticks(5);
    const decimals = Math.max(0, -Math.floor(Math.log10(ticks[1] - ticks[0])));
    for (const tick of ticks) {
      svg
        .append('text')
        .attr('class', 'soft')
        .attr('x', percent(x(tick)))
        .attr('y', 30)
        .attr('text-anchor', 'middle')
        .style('font-size', '11px')
        .text(dmrp.numbers.signed(tick, decimals));
    }
    const words = (text, anchor, at) =>
      svg
        .append('text')
        .attr('class', 'soft')
        .attr('x', percent(at))
        .attr('y', 11)
        .attr('text-anchor', anchor)
        .style('font-size', '11px')
        .text(text);
    if (left_words) words(left_words, 'start', 0);
    if (right_words) words(right_words, 'end', 100);
    return holder;
  }

  dmrp.interval_rows = {scale, cell, axis};
})(window.dmrp);
