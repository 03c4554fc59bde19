"""The living page: one file that draws a machine and solves it again when it is changed."""
