window.dmrp = window.dmrp || {}; dmrp.diagnosis = {mount: () => false, show() {}};
