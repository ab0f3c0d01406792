// SPDX-License-Identifier: MIT
// plots.js: what all plots share: frames, axes, shapes, the tip, panels side by side.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';
  const element = (...all) => dmrp.elements.element(...all);

  // Draws now and again when the width changes. draw(holder, width) fills the holder.
  function responsive(holder, draw) {
    let drawn = 0;
    const redraw = () => {
      const width = Math.floor(holder.clientWidth);
      if (width === 0 || width === drawn) return;
      drawn = width;
      draw(holder, width);
    };
    new ResizeObserver(() => window.requestAnimationFrame(redraw)).observe(holder);
    redraw();
    return () => {
      drawn = 0;
      redraw();
    };
  }

  function frame(holder, width, height, label) {
    return d3
      .select(holder)
      .append('svg')
      .attr('viewBox', `0 0 ${width} ${height}`)
      .attr('width', width)
      .attr('height', height)
      .attr('role', 'img')
      .attr('aria-label', label);
  }

  // Not more ticks than there is room for.
  function ticks_for(length, each) {
    return Math.max(2, Math.floor(length / each));
  }

  function number_format(value) {
    return dmrp.numbers.fixed(value, Math.min(6, (String(value).split('.')[1] || '').length));
  }

  function axis_bottom(parent, scale, y, title, options = {}) {
    const [left, right] = scale.range();
    const axis = d3
      .axisBottom(scale)
      .ticks(ticks_for(right - left, 48))
      .tickSize(4)
      .tickPadding(5)
      .tickFormat(number_format);
    const made = parent.append('g').attr('class', 'axis').attr('transform', `translate(0,${y})`).call(axis);
    if (title) {
      made
        .append('text')
        .attr('class', 'title')
        .attr('x', options.title_x === undefined ? (left + right) / 2 : options.title_x)
        .attr('y', 34)
        .attr('text-anchor', 'middle')
        .text(title);
    }
    return made;
  }

  function axis_left(parent, scale, x) {
    const [bottom, top] = scale.range();
    const axis = d3
      .axisLeft(scale)
      .ticks(ticks_for(bottom - top, 36))
      .tickSize(4)
      .tickPadding(4)
      .tickFormat(number_format);
    return parent.append('g').attr('class', 'axis').attr('transform', `translate(${x},0)`).call(axis);
  }

  // With room at both ends; a scale of a single value is widened.
  function linear(values, range, {zero = false} = {}) {
    let [low, high] = d3.extent(values.filter(dmrp.numbers.is_number));
    if (low === undefined) [low, high] = [0, 1];
    if (zero) [low, high] = [Math.min(0, low), Math.max(0, high)];
    const room = low === high ? Math.max(0.5, Math.abs(low) * 0.1) : (high - low) * (zero ? 0 : 0.05);
    return d3
      .scaleLinear()
      .domain([low >= 0 ? Math.max(0, low - room) : low - room, high + room])
      .range(range)
      .nice();
  }

  const SYMBOLS = [
    'symbolCircle',
    'symbolTriangle',
    'symbolSquare',
    'symbolDiamond',
    'symbolStar',
    'symbolWye',
    'symbolCross',
  ];

  function symbol(index, size = 44) {
    return d3
      .symbol()
      .type(d3[SYMBOLS[index % SYMBOLS.length]])
      .size(size)();
  }

  // What a trial that failed is drawn as.
  function cross(radius = 3.6) {
    return `M${-radius},${-radius}L${radius},${radius}M${-radius},${radius}L${radius},${-radius}`;
  }

  // entries: [{label, colour, path, failed?, line?, dash?}]
  function legend(entries) {
    const list = element('ul', {class: 'legend'});
    for (const entry of entries) {
      const item = element('li');
      const width = entry.line ? 28 : 14;
      const svg = d3.select(item).append('svg').attr('width', width).attr('height', 14).attr('aria-hidden', 'true');
      if (entry.line)
        svg
          .append('line')
          .attr('x1', 0)
          .attr('x2', width)
          .attr('y1', 7)
          .attr('y2', 7)
          .attr('class', 'line')
          .style('stroke', entry.colour)
          .style('stroke-dasharray', entry.dash);
      svg
        .append('path')
        .attr('transform', `translate(${width / 2},7)`)
        .attr('d', entry.path)
        .attr('class', entry.failed ? 'mark failed' : 'mark')
        .style('--colour', entry.colour)
        .style('fill', entry.failed ? 'none' : entry.colour);
      item.append(entry.label);
      list.append(item);
    }
    return list;
  }

  // A legend of one kind's labels: empty where there is only one.
  function field_legend(data, field, line = false) {
    const values = dmrp.labels.values_of(data, field);
    if (values.length < 2) return null;
    return legend(
      values.map((value) => {
        const series = dmrp.labels.series(data, field, value);
        return {
          label: dmrp.labels.named(value),
          colour: series.colour,
          path: symbol(series.symbol),
          line,
          dash: series.dash,
        };
      })
    );
  }

  // Near `target`'s box, inside the window.
  function show_tip(target, ...content) {
    const tip = document.getElementById('tip');
    dmrp.elements.fill(tip, content);
    tip.hidden = false;
    const of = target.getBoundingClientRect();
    const own = tip.getBoundingClientRect();
    const left = Math.min(Math.max(8, of.left + of.width / 2 - own.width / 2), window.innerWidth - own.width - 8);
    const above = of.top - own.height - 8;
    tip.style.left = `${left}px`;
    tip.style.top = `${above > 8 ? above : of.bottom + 8}px`;
  }

  function hide_tip() {
    document.getElementById('tip').hidden = true;
  }

  const text_measure = () => document.createElement('canvas').getContext('2d');

  // Width in pixels of the longest of `texts` at the size of labels.
  function text_width(texts) {
    const context = text_measure();
    context.font = `12px ${window.getComputedStyle(document.body).fontFamily}`;
    return Math.max(0, ...texts.map((text) => context.measureText(text).width));
  }

  // Cut to `width` pixels; the whole of it for who points at it.
  function fit_text(text, words, width) {
    let shown = words;
    while (shown.length > 4 && text_width([shown]) > width) shown = `${shown.slice(0, -2).trimEnd()}…`;
    text.text(shown);
    if (shown !== words) text.append('title').text(words);
  }

  const SMALL_PANELS = {least: 240, most: 520, most_columns: 4};

  // Panels in columns of `least` to `most` pixels. Returns their elements.
  function panels(holder, titles, {least, most, most_columns}) {
    const columns = Math.max(1, Math.min(most_columns, titles.length));
    const grid = element('div', {class: 'facets'});
    grid.style.maxWidth = `${columns * most}px`;
    const share = `calc((100% - ${columns - 1} * 1.75rem) / ${columns})`;
    grid.style.gridTemplateColumns = `repeat(auto-fill, minmax(max(min(100%, ${least}px), ${share}), 1fr))`;
    const made = titles.map((title) => {
      const panel = element(
        'div',
        {class: 'facet'},
        title && element('h4', {}, title),
        element('div', {class: 'plot'})
      );
      grid.append(panel);
      return panel;
    });
    holder.append(grid);
    return made;
  }

  dmrp.plots = {
    responsive,
    frame,
    axis_bottom,
    axis_left,
    linear,
    symbol,
    cross,
    legend,
    field_legend,
    show_tip,
    hide_tip,
    text_width,
    fit_text,
    SMALL_PANELS,
    panels,
  };
})(window.dmrp);
