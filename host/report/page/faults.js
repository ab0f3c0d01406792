// SPDX-License-Identifier: MIT
// faults.js: what plugins did wrong, with the command that does it again.
window.dmrp = window.dmrp || {};
(function (dmrp) {
  'use strict';
  const element = (...all) => dmrp.elements.element(...all);
  const AT_FIRST = 20;
  const SIGNALS = {
    4: 'SIGILL',
    6: 'SIGABRT',
    7: 'SIGBUS',
    8: 'SIGFPE',
    9: 'SIGKILL',
    11: 'SIGSEGV',
    15: 'SIGTERM',
    24: 'SIGXCPU',
  };

  function where_words(data, fault) {
    const row = data.trials.id.indexOf(fault.trial);
    const trial = row < 0 ? `trial ${fault.trial}` : `${dmrp.labels.trial(data, row)} · seed ${data.trials.seed[row]}`;
    const signal = fault.signal !== null && (SIGNALS[fault.signal] || `signal ${fault.signal}`);
    return [trial, `step ${fault.step}`, fault.robot !== null && `robot ${fault.robot}`, signal]
      .filter(Boolean)
      .join(' · ');
  }

  function item(data, fault) {
    return element(
      'li',
      {class: 'fault'},
      element(
        'h3',
        {},
        element('span', {class: 'kind'}, fault.kind.replace(/_/g, ' ')),
        ` ${fault.plugin}`,
        fault.function && element('code', {}, ` ${fault.function}()`)
      ),
      element('p', {class: 'where number'}, where_words(data, fault)),
      fault.detail && element('p', {class: 'detail-text'}, fault.detail),
      element(
        'div',
        {class: 'command'},
        element('code', {}, fault.rerun),
        dmrp.controls.copy_button(fault.rerun, `the command that runs trial ${fault.trial} again`)
      )
    );
  }

  // "3 crash, 1 hang"
  function count_words(faults) {
    const kinds = dmrp.labels.distinct(faults.map((fault) => fault.kind));
    return kinds
      .map((kind) => `${faults.filter((fault) => fault.kind === kind).length} ${kind.replace(/_/g, ' ')}`)
      .join(', ');
  }

  function mount(body, data) {
    if (data.faults.length === 0) return 'no plugin failed';
    const list = element(
      'ul',
      {class: 'faults'},
      data.faults.slice(0, AT_FIRST).map((fault) => item(data, fault))
    );
    const rest = data.faults.slice(AT_FIRST);
    const more =
      rest.length > 0 &&
      element(
        'button',
        {
          type: 'button',
          class: 'button',
          onclick: () => {
            list.append(...rest.map((fault) => item(data, fault)));
            more.remove();
          },
        },
        `Show the other ${rest.length}`
      );
    dmrp.elements.fill(body, element('p', {class: 'note'}, `${count_words(data.faults)}.`), list, more);
    return null;
  }

  dmrp.faults = {mount, count_words};
})(window.dmrp);
