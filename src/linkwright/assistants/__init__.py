"""Tools for assistants: a server of the Model Context Protocol over the public library, bound to one folder."""
