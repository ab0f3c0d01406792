window.dmrp = window.dmrp || {}; dmrp.pedestrian_delay = {mount: () => false, show() {}};
