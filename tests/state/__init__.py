"""Every public number and finding of the product as data, and what differs between two such files."""
