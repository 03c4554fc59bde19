"""What takes room in a machine: plates, pins, blocks, guides, wheels and cams, each with a shape on its link."""
