"""sweep 命令。"""

WORDS = {
    "summary": "大量设计的数，逐份计算，也可在集群上",
    "description": """\
计算各范围的全部组合或 Sobol 序列的汇总与设计指标，逐份写成一个文件夹中的 Parquet 文件。
文件整份写入；中断后再次运行，只算缺少的份。所需内存不随设计数增长。给出 --cluster 时
由 Dask 调度器的工作进程计算，结果逐位相同；工作进程可以中途退出。""",
    "numbers_help": "汇总如 'rocker.angle range' 与设计指标如 peak_reaction",
    "folder_help": "Parquet 文件的文件夹；没有时新建，已有时继续",
    "part_help": "每份的设计数，进位到二的幂（默认 16384）",
    "cluster_help": "Dask 调度器的地址，如 tcp://host:8786（附加项 cluster）；否则用本机线程",
    "best_help": "另列出此数最优的十个设计：越大越好者（如传动角）取最大，其余取最小",
    "computing": "方案",
    "done": "{folder} 中有 {designs} 个设计，共 {parts} 份（其中 {skipped} 份已有）；数值为 SI",
    "column.number": "列",
    "column.least": "最小",
    "column.greatest": "最大",
    "column.designs": "设计数",
    "best": "{number} 最优：",
}
