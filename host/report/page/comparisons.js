window.dmrp = window.dmrp || {}; dmrp.comparisons = {mount: () => false, show() {}};
