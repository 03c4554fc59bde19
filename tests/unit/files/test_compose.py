"""Composing YAML: places of nodes, YAML 1.2's scalars, JSON's escapes, the parser in Python, bad texts."""

import json
from dataclasses import replace

import pytest
import yaml

from linkwright.fields.nodes import Mapping, Node, Scalar
from linkwright.files import compose as yaml_source
from linkwright.files.compose import _below, compose
from linkwright.files.model_file import gallery_names, loads
from linkwright.files.source import read_source


def texts_at(text: str) -> list[str]:
    """What stands in the text at the places of its nodes."""
    root, remarks = compose(text)
    assert root is not None and remarks == []
    return [text[node.start : node.end] for node in _below(root)]


def scalars(node: Node) -> list[str]:
    return [each.text for each in _below(node) if isinstance(each, Scalar)]


@pytest.mark.parametrize("name", gallery_names())
def test_both_parsers_give_the_same_nodes(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    text, _ = read_source(f"gallery:{name}")
    fast = compose(text)

    class Pure(yaml.BaseLoader):
        descend_resolver, ascend_resolver = (
            yaml_source._Loader.descend_resolver,
            yaml_source._Loader.ascend_resolver,
        )
        depth = count = 0

    monkeypatch.setattr(yaml_source, "_Loader", Pure)
    assert compose(text) == fast


def test_places_are_lines_columns_and_offsets_of_characters() -> None:
    text = "é: 😀\nb: [1 mm, {c: 'd'}]\n"
    root, _ = compose(text)
    assert isinstance(root, Mapping)
    node = root.get("b")
    assert node is not None
    assert (node.line, node.column, text[node.start : node.end]) == (1, 3, "[1 mm, {c: 'd'}]")
    assert {"é", "😀", "1 mm", "'d'", "c"} <= set(texts_at(text))


@pytest.mark.parametrize("word", ["on", "no", "yes", "12:30", "1_000", "0o17", "=", "2024-01-01", "~x", "NULLs"])
def test_words_stay_words(word: str) -> None:
    root, remarks = compose(f"a: {word}")
    assert remarks == []
    assert isinstance(root, Mapping)
    value = root.get("a")
    assert isinstance(value, Scalar) and value.text == word and not value.empty


def test_pairs_of_json_are_one_character_and_places_stay() -> None:
    text = '{"a\\ud83d\\ude00": ["\\ud83d\\uDE00x", "\\\\ud83d"],\n "b": "\\ud83d\\ude00", "c": 1}'
    root, remarks = compose(text)
    assert root is not None and remarks == []
    assert sorted(scalars(root)) == sorted(["a😀", "😀x", "\\ud83d", "b", "😀", "c", "1"])
    assert {'"a\\ud83d\\ude00"', '"\\ud83d\\uDE00x"', '"\\\\ud83d"', '"c"', "1"} <= set(texts_at(text))
    assert json.loads(text)["b"] == "😀"


def test_half_of_a_pair_is_refused() -> None:
    root, remarks = compose('a: "\\ud83d"')
    assert root is None
    assert [(each.code, each.line) for each in remarks] == [("syntax", 0)]


def test_a_colon_before_a_bracket_belongs_to_the_key() -> None:
    text = "{a:, b: {c:}, d:[1, e:], f: 'g:}'}"
    assert set(texts_at(text)) >= {"a", "b", "c", "d", "e", "'g:}'", "1", "{c:}", "[1, e:]"}
    broken, remarks = compose("{" + ", ".join(f"k{i}:" for i in range(60)) + "}")
    assert broken is None and [each.code for each in remarks] == ["syntax"]


@pytest.mark.parametrize("mark", ["\x85", "\u2028", "\u2029"])
def test_lines_are_counted_as_editors_do(mark: str) -> None:
    root, _ = compose(f"# a{mark}b\nc: 1")
    assert isinstance(root, Mapping) and root.entries[0].key.line == 1


@pytest.mark.parametrize("code", ["\\x1b", "\\0", "\\uFFFE", "\\uffff", "\\x9b", "\\r"])
def test_a_control_character_in_a_text_is_a_finding_and_never_passes(code: str) -> None:
    root, remarks = compose(f'name: "a{code}b"')
    assert [each.code for each in remarks] == ["control-character"]
    assert root is not None and "a\ufffdb" in scalars(root)


@pytest.mark.parametrize("text", ["a: &x 1\nb: &x 2", "a: 1\nb: *x", "a: 1\n---\nb: 1", "a: 1\nb: " + "[" * 10**6])
def test_what_makes_no_tree_is_refused_where_it_is(text: str) -> None:
    root, (remark,) = compose(text)
    assert root is None and remark.line == 1 and remark.code in {"alias", "documents", "depth"}


def test_an_empty_value_is_placed_behind_its_key_and_can_be_filled() -> None:
    root, _ = compose("a:\nb: 1\n")
    assert isinstance(root, Mapping)
    node = root.get("a")
    assert node is not None and (node.line, node.column, node.start) == (0, 2, 2)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "kite"])
def test_a_model_reads_the_same_as_json(name: str) -> None:
    text, _ = read_source(f"gallery:{name}")
    root, _ = compose(text)

    def plain(node: Node) -> object:
        if isinstance(node, Mapping):
            return {key: plain(value) for key, value in node}
        return node.text if isinstance(node, Scalar) else [plain(each) for each in getattr(node, "items")]  # noqa: B009

    assert root is not None
    for ascii_only in (True, False):
        again = loads(json.dumps(plain(root), ensure_ascii=ascii_only))
        assert replace(again, expected={}) == replace(loads(text), expected={})  # quoted numbers are texts
