// SPDX-License-Identifier: MIT
// judgement.js: what a difference between two runs says: better, worse, or nothing that can be told.
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';

const SIGNIFICANT = 0.05;

// 'better', 'worse', 'changed' (neither direction is better), 'equal', 'unclear' or 'undefined'.
export function of(data, difference) {
  if (difference.pairs === 0) return 'undefined';
  if (difference.equal) return 'equal';
  if (difference.p_holm === null || !(difference.p_holm < SIGNIFICANT)) return 'unclear';
  const {direction} = labels.metric(data, difference.metric);
  if (direction === 'none') return 'changed';
  return difference.difference > 0 === (direction === 'higher') ? 'better' : 'worse';
}

export const WORDS = {
  better: 'better',
  worse: 'worse',
  changed: 'changed',
  equal: 'equal',
  unclear: 'no significant difference',
  undefined: 'no pair',
};

export function decimals(data, difference) {
  return labels.decimals(data, difference.metric, [difference.before, difference.after, difference.difference]);
}

// "+0.12 [0.05, 0.20]"
export function difference_words(data, difference) {
  const digits = decimals(data, difference);
  const interval = numbers.interval(difference.low, difference.high, digits, numbers.signed);
  return `${numbers.signed(difference.difference, digits)}${interval && ` ${interval}`}`;
}
