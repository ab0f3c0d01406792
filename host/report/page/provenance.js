window.dmrp = window.dmrp || {}; dmrp.provenance = {mount: () => false, show() {}};
