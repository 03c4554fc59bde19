"""Drawing sheets: frame, title block and panels laid out on paper of a standard size, as PDF, SVG and DXF."""
