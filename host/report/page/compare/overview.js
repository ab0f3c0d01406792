// SPDX-License-Identifier: MIT
// overview.js: the head of a comparison: which runs, and what became better or worse.
import {element, fill, hidden} from '../elements.js';
import * as labels from '../labels.js';
import * as numbers from '../numbers.js';
import {date_words} from '../run/overview.js';
import * as theme from '../theme.js';
import * as judgement from './judgement.js';

const KINDS = {
  better: {kind: 'good', mark: '✓', words: 'Better'},
  worse: {kind: 'bad', mark: '✕', words: 'Worse'},
  changed: {kind: 'note', mark: 'i', words: 'Changed'},
};

function metric_words(data, difference) {
  const unit = labels.metric_unit(data, difference.metric);
  return `${labels.metric_title(data, difference.metric)} ${numbers.with_unit(
    judgement.difference_words(data, difference),
    unit
  )}`;
}

// The lines of the verdict on one run: [{kind, mark, text}].
export function lines(data, run) {
  const of = (judged) => run.differences.filter((one) => judgement.of(data, one) === judged);
  const found = Object.entries(KINDS)
    .filter(([judged]) => of(judged).length > 0)
    .map(([judged, {kind, mark, words}]) => ({
      kind,
      mark,
      text: `${words} over all trials: ${of(judged)
        .map((one) => metric_words(data, one))
        .join('; ')}.`,
    }));
  if (run.differences.length > 0 && run.differences.every((one) => judgement.of(data, one) === 'equal'))
    found.push({kind: 'good', mark: '=', text: 'All values are equal in every trial.'});
  else if (found.length === 0)
    found.push({kind: 'note', mark: 'i', text: 'No metric differs significantly over all trials.'});
  const n = Math.max(0, ...run.differences.map((one) => one.n));
  if (n < numbers.FEWEST)
    found.push({
      kind: 'warning',
      mark: '!',
      text: `n = ${n}: no difference is significant with fewer than ${numbers.FEWEST}.`,
    });
  const alone = run.only_before + run.only_after;
  if (alone > 0)
    found.push({
      kind: 'warning',
      mark: '!',
      text:
        `${numbers.counted(alone, 'trial')} without a partner (${run.only_before} before, ${run.only_after} after) ` +
        `${alone === 1 ? 'is' : 'are'} left out.`,
    });
  return found;
}

function run_words(run) {
  const built = run.commit ? `${run.version}, ${run.commit.slice(0, 12)}` : run.version;
  return `${run.path} · ${date_words(run.started)} · dmrp ${built}`;
}

function verdict(data, run) {
  return element(
    'ul',
    {class: 'verdict'},
    lines(data, run).map((line) =>
      element(
        'li',
        {class: line.kind},
        element('span', {class: 'mark', 'aria-hidden': 'true'}, line.mark),
        element('span', {}, data.runs.length > 1 && hidden(`${run.path}: `), line.text)
      )
    )
  );
}

function choices(data) {
  const list = element('dl', {class: 'choices'});
  const add = (title, text) => list.append(element('dt', {}, title), element('dd', {}, text));
  add('before', run_words(data.before));
  for (const run of data.runs) add('after', run_words(run));
  return list;
}

export function mount(body, data) {
  const title = data.before.name;
  document.title = `${title} · dmrp comparison`;
  const pairs = data.runs.map((run) => numbers.counted(run.pairs, 'trial')).join(' and ');
  fill(
    body,
    element(
      'div',
      {class: 'title-line'},
      element('div', {}, element('p', {class: 'kicker'}, 'dmrp comparison of runs'), element('h1', {}, title)),
      theme.button()
    ),
    element('p', {class: 'subtitle'}, `${pairs} with the same scenario, robots, seed and labels of plugins in both runs`),
    choices(data),
    data.runs.map((run) => [data.runs.length > 1 && element('h3', {class: 'compared'}, run.path), verdict(data, run)])
  );
}
