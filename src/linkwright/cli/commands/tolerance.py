"""``linkwright tolerance``: what tolerances and clearances do to a mechanism's numbers, also on a cluster."""

from __future__ import annotations

import argparse

from linkwright.cli.parser import Options
from linkwright.cli.part import part_arguments, run_part
from linkwright.cli.session import Session


def arguments(option: Options) -> None:
    part_arguments(option)
    option("--cluster", "ADDRESS", words="sweep.cluster_help")


def run(options: argparse.Namespace, session: Session) -> int:
    """Solves the file's problem; its drawn machines are computed by threads or a cluster."""
    from linkwright.study.cluster import on_cluster

    with on_cluster(options.cluster):
        return run_part(options, session, "tolerance")
