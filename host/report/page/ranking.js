// SPDX-License-Identifier: MIT
// ranking.js: sorts values, and knows which are marked as the best. A metric's direction is "higher", "lower" (better) or "none".

export function is_defined(value) {
  return value !== null && value !== undefined && !Number.isNaN(value);
}

// Undefined values come last in both directions.
export function compare(a, b, descending) {
  if (!is_defined(a) || !is_defined(b)) return Number(!is_defined(a)) - Number(!is_defined(b));
  const order = typeof a === 'string' ? a.localeCompare(b, 'en', {numeric: true}) : a - b;
  return descending ? -order : order;
}

// The indices of `values` in sorted order. The sort is stable.
export function order(values, descending) {
  return values.map((_, i) => i).sort((i, j) => compare(values[i], values[j], descending) || i - j);
}

const LABELS = ['scenario', 'robots', 'global_planner', 'local_controller', 'pedestrian_model'];

// Whether the host marks this metric of a combination or planner as the best of its column (best_marks.hpp).
export function is_best(data, row, metric) {
  return data.best.some(
    (mark) => mark.metric === metric && LABELS.every((field) => mark[field] === (field in row ? row[field] : ''))
  );
}

// Scales values to 0 (worst) to 1 (best), null if undefined, 0.5 if all are equal. Without a direction the highest
// value gets 1.
export function goodness(values, direction) {
  const defined = values.filter(is_defined);
  const low = Math.min(...defined);
  const high = Math.max(...defined);
  return values.map((value) => {
    if (!is_defined(value)) return null;
    if (low === high) return 0.5;
    const share = (value - low) / (high - low);
    return direction === 'lower' ? 1 - share : share;
  });
}

// The order after the first click on a column.
export function descending_first(direction) {
  return direction === 'higher';
}
