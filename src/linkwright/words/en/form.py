"""What a key of a model file may hold."""

WORDS = {
    "add_key": "add {key_}: {form}",
    "one_of": "one of {names}",
    "such_as": "{noun}, such as {example}",
    "formula": "{noun}, an expression of {variables}",
    "name_of_link": "a link's name",
    "name_of_joint": "a joint's name",
    "name_of_point": "a point's name",
    "name_of_link_point": "a point as link.point",
    "name_of_output": "an output",
    "either": "one of these forms: {several}",
    "list_of_so_many": "a list of {count}: {item}",
    "list_of": "a list: {item}",
    "by_name": "a mapping by name: {item}",
    "keys": "a mapping with keys of {names}",
    "whole": "a whole number",
    "any_quantity": "a number or a quantity",
    "text": "a text",
    "value": "a value",
}
