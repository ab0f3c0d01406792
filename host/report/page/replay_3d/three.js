// SPDX-License-Identifier: MIT
// three.js: loads the library three.js, which the page embeds as gzip in #dmrp-three.
import {unpacked_text} from '../packed_text.js';

export let THREE = null; // set by load_three()

// Runs the library's script once. Rejects if it cannot be unpacked.
export async function load_three() {
  if (THREE) return;
  const text = await unpacked_text(document.getElementById('dmrp-three'));
  const script = document.createElement('script');
  script.textContent = text;
  document.head.append(script);
  script.remove();
  THREE = window.THREE;
}
