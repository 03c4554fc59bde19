"""The command ``sweep``."""

WORDS = {
    "summary": "numbers of very many designs, part by part, also on a cluster",
    "description": """\
Computes summaries and design numbers of every combination of ranges, or of a
Sobol sequence, part by part into a folder of Parquet files. Files are written
whole; run again after an interruption, it goes on with the missing parts. Memory
does not grow with the designs. With --cluster the parts are computed by the
workers of a Dask scheduler, to the same bits; workers may die.""",
    "numbers_help": "summaries such as 'rocker.angle range' and design numbers such as peak_reaction",
    "folder_help": "folder of the Parquet files; made where it does not exist, gone on with where it does",
    "part_help": "designs of a part, rounded up to a power of two (default 16384)",
    "cluster_help": "address of a Dask scheduler, such as tcp://host:8786 (extra cluster); else threads here",
    "best_help": "also the ten designs best in this number: the greatest where more is better, as of a "
    "transmission angle, else the least",
    "computing": "designs",
    "done": "{designs} designs in {parts} parts in {folder} ({skipped} were there already); values in SI",
    "column.number": "column",
    "column.least": "least",
    "column.greatest": "greatest",
    "column.designs": "designs",
    "best": "Best {number}:",
}
