"""OpenLinkage: projects of the free designer, and machines by parameters."""
