window.dmrp = window.dmrp || {}; dmrp.completion = {mount: () => false, show() {}};
