"""English: files that are written."""

WORDS = {
    "is_folder": '"{path}" is a folder; name a file',
    "no_folder": 'there is no folder "{path}"; create it first',
    "no_folder_there": '"{there}" is a file, so there can be no folder "{path}"; choose another name',
    "exists": '"{path}" exists; choose another name, or replace it with {remedy}',
    "cannot_write": 'the file "{path}" cannot be written ({reason}); choose another name or a folder of your '
    "own",
    "cannot_make": 'the folder "{path}" cannot be made ({reason}); choose another name or a folder of your own',
}
