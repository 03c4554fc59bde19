"""Why the operating system refuses a file, by the name of its error."""

WORDS = {
    "ENOENT": "No such file or directory",
    "EACCES": "Permission denied",
    "EPERM": "Operation not permitted",
    "EISDIR": "Is a directory",
    "ENOTDIR": "Not a directory",
    "ENOSPC": "No space left on device",
    "EROFS": "Read-only file system",
    "ENAMETOOLONG": "File name too long",
    "EADDRINUSE": "Address already in use",
    "EIO": "Input/output error",
}
