"""What a mechanism is: links, their geometry, the one frozen type, its drawing."""
