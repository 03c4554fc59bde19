"""The command ``schema``."""

WORDS = {
    "summary": "JSON Schema of models and calculations, for editors",
    "description": "Prints the JSON Schema of models and calculations (draft 2020-12), generated from the model "
    "itself.\nEditors complete keys and mark mistakes with it: write as the first line of a model\n# "
    "yaml-language-server: $schema=./linkwright.schema.json",
    "output_help": "write it to a file",
}
