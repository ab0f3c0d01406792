// SPDX-License-Identifier: MIT
// start.js: reads the data and shows the page.
(function () {
  "use strict";
  const dmrp = (window.dmrp = window.dmrp || {});
  dmrp.data = JSON.parse(document.getElementById("dmrp-data").textContent);
  document.title = dmrp.data.run.name;
  const heading = document.createElement("h1");
  heading.textContent = dmrp.data.run.name;
  document.getElementById("report").append(heading);
})();
