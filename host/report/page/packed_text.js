// SPDX-License-Identifier: MIT
// packed_text.js: unpacks gzip in base64 (host/report/replay/page_packing.hpp) to text.

// Rejects if the browser has no DecompressionStream or the data are damaged.
export async function unpacked_text(element) {
  const bytes = Uint8Array.from(atob(element.textContent.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).text();
}
