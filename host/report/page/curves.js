window.dmrp = window.dmrp || {}; dmrp.curves = {mount: () => false, show() {}};
