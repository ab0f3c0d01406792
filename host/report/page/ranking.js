// SPDX-License-Identifier: MIT
// ranking.js: sorts values and finds the best. A metric's direction is "higher", "lower" (better) or "none".

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

// Indices of the best values after rounding. Empty if the metric has no direction, or if more than half of the values
// are equally good.
export function best(exact, direction, decimals) {
  const values = exact.map((value) => (is_defined(value) ? Number(value.toFixed(decimals)) : null));
  const defined = values.filter(is_defined);
  if (direction === 'none' || defined.length < 2) return new Set();
  const target = direction === 'higher' ? Math.max(...defined) : Math.min(...defined);
  const found = values.map((value, i) => (value === target ? i : -1)).filter((i) => i >= 0);
  return new Set(found.length > defined.length / 2 ? [] : found);
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
