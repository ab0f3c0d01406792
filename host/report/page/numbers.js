// SPDX-License-Identifier: MIT
// numbers.js: formats numbers, intervals and units.

export const UNDEFINED = '—';
export const FEWEST = 5; // observations of which a test has a p (paired_difference.hpp)
export const FEWEST_FOR_CORRELATION = 6; // tasks (rank_correlation.hpp)

export function is_number(value) {
  return typeof value === 'number' && Number.isFinite(value);
}

// With the character U+2212 as minus sign, and without a sign for zero.
export function fixed(value, decimals) {
  if (!is_number(value)) return UNDEFINED;
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? '\u2212' + text : text;
}

// The decimals with which the largest of `values` has three significant digits; 0 if all are integers.
export function decimals_of(values) {
  const defined = values.filter(is_number);
  if (defined.every(Number.isInteger)) return 0;
  const largest = Math.max(...defined.map(Math.abs));
  return Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(largest))));
}

export function general(value) {
  return is_number(value) ? fixed(value, decimals_of([value])) : UNDEFINED;
}

export function signed(value, decimals) {
  const text = fixed(value, decimals);
  return is_number(value) && value > 0 && Number(text) !== 0 ? '+' + text : text;
}

// Empty if both ends round to the same text.
export function interval(low, high, decimals, write = fixed) {
  if (!is_number(low) || !is_number(high) || fixed(low, decimals) === fixed(high, decimals)) return '';
  return `[${write(low, decimals)}, ${write(high, decimals)}]`;
}

// "0 of 20: at most 14 %", where no observation had any of what is counted; else empty.
export function none_of({n, at_most}) {
  return is_number(at_most) ? `0 of ${n}: at most ${percent(at_most)}` : '';
}

export function p_value(p) {
  if (!is_number(p)) return UNDEFINED;
  return p < 0.001 ? '< 0.001' : p.toFixed(3);
}

export function too_few(count) {
  return `too few (${count})`;
}

export function percent(share) {
  return is_number(share) ? `${fixed(100 * share, 0)} %` : UNDEFINED;
}

// Dimensionless values have the unit "1".
export function unit(name) {
  return name === '1' || name === '' ? '' : name;
}

export function with_unit(text, name) {
  return unit(name) && text !== UNDEFINED ? `${text}\u00a0${name}` : text;
}

export function counted(count, noun, plural = noun + 's') {
  return `${count.toLocaleString('en')} ${count === 1 ? noun : plural}`;
}

export function duration(seconds) {
  if (seconds < 90) return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`;
  if (seconds < 5400) return `${(seconds / 60).toFixed(0)} min`;
  return `${(seconds / 3600).toFixed(1)} h`;
}
