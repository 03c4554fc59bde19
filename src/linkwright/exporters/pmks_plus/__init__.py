"""Share links of PMKS+: a machine as its records, and records as a link."""
