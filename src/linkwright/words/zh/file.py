"""Chinese: files that are written."""

WORDS = {
    "is_folder": "“{path}”是文件夹；请给出文件名",
    "no_folder": "没有文件夹“{path}”；请先建立",
    "no_folder_there": "“{there}”是文件，因此不能有文件夹“{path}”；请换一个名称",
    "exists": "“{path}”已存在；请换一个名称，或用 {remedy} 覆盖",
    "cannot_write": "无法写入文件“{path}”（{reason}）；请换一个名称，或选自己的文件夹",
    "cannot_make": "无法建立文件夹“{path}”（{reason}）；请换一个名称，或选自己的文件夹",
}
