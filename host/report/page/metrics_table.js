window.dmrp = window.dmrp || {}; dmrp.metrics_table = {mount: () => false, show() {}};
