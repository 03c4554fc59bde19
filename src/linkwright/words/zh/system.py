"""操作系统拒绝的原因，按错误名。"""

WORDS = {
    "ENOENT": "没有这个文件或文件夹",
    "EACCES": "没有权限",
    "EPERM": "不允许此操作",
    "EISDIR": "这是文件夹",
    "ENOTDIR": "这不是文件夹",
    "ENOSPC": "磁盘已满",
    "EROFS": "文件系统只读",
    "ENAMETOOLONG": "文件名太长",
    "EADDRINUSE": "地址已被占用",
    "EIO": "读写出错",
}
