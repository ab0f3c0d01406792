window.dmrp = window.dmrp || {}; dmrp.faults = {mount: () => false, show() {}};
