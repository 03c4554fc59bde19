"""Registries of the elements: joints, drivers' laws, loads and everything else that is one file per kind."""

from __future__ import annotations

import importlib.util
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Generic, TypeVar, cast

from linkwright.core.entry_points import loaded, modules_within, offered_by_packages
from linkwright.errors import LinkwrightError, UnknownName
from linkwright.words import Message, _, pgettext
from linkwright.words.synonyms import nearest_in_meaning

T = TypeVar("T")
#: Names of which a sentence lists all, and among which the nearest is looked for, at most.
MOST_SHOWN, MOST_COMPARED = 60, 300
#: Similarity of two names above which one is a misspelling of the other, is probably meant, may be meant.
MISSPELT, PROBABLE, POSSIBLE = 0.8, 0.7, 0.5


THERE_IS = _("there is {names}")
#: What was probably meant and all that exist, or only these.
LISTINGS = {
    "there_is": (_('did you mean "{offer}"? (there is: {names})'), _("there is: {names}")),
    "known": (_('did you mean "{offer}"? (known: {names})'), _("known: {names}")),
    "one_of": (_('did you mean "{offer}"? (one of: {names})'), pgettext("names", "one of: {names}")),
}


class Registry(Mapping[str, T], Generic[T]):
    """Elements of one package under their names; its modules are imported at first use.

    An element registers itself with ``@REGISTRY.register("name")``; adding one touches no other file. Asked for one
    name, the module of that name is looked into first; the others wait until it is not there, or all are asked for.
    """

    def __init__(
        self, noun: Message, package: str, *, entry_points: str | None = None, attribute: str | None = None
    ) -> None:
        """``entry_points``: the group under which installed packages name modules with further elements;
        ``attribute``: where a class finds the name under which it is filed, unless it has its own there."""
        self.noun = noun
        self._package = package
        self._entry_points = entry_points
        self._attribute = attribute
        self._elements: dict[str, T] = {}
        self._lock = threading.RLock()
        self._discovered = self._discovering = False

    def register(self, name: str) -> Callable[[T], T]:
        """Decorator that files an element under ``name``; a name is used once."""

        def file_under(element: T) -> T:
            if name in self._elements and _home(self._elements[name]) != _home(element):
                raise LinkwrightError(
                    _(
                        'the {noun} "{name}" is registered twice; choose another name',
                        code="names.twice",
                        noun=self.noun,
                        name=name,
                    )
                )
            self._elements[name] = element
            if self._attribute is not None and self._attribute not in vars(element):
                setattr(element, self._attribute, name)
            return element

        return file_under

    def __getitem__(self, name: str) -> T:
        if name not in self._elements and name not in self:
            raise UnknownName(no_such(self.noun, name, sorted(self._elements)))
        return self._elements[name]

    def __contains__(self, name: object) -> bool:
        if name not in self._elements and not self._discovered:
            self._look_into(str(name).lower())
            if name not in self._elements:
                self._discover()
        return name in self._elements

    def __iter__(self) -> Iterator[str]:
        self._discover()
        return iter(sorted(self._elements))

    def __len__(self) -> int:
        self._discover()
        return len(self._elements)

    def _look_into(self, module: str) -> None:
        """Imports the module of this name, if the package has it."""
        if module.isidentifier() and importlib.util.find_spec(f"{self._package}.{module}") is not None:
            importlib.import_module(f"{self._package}.{module}")

    def _discover(self) -> None:
        """Imports the package's modules once; other threads wait until all are there."""
        if self._discovered:
            return
        with self._lock:
            if self._discovered or self._discovering:
                return
            self._discovering = True
            try:
                package = importlib.import_module(self._package)
                for name in modules_within(package.__path__):
                    importlib.import_module(f"{self._package}.{name}")
                self._load_installed()
                self._discovered = True
            finally:
                self._discovering = False

    def _load_installed(self) -> None:
        """Imports what other installed packages offer; an element registers itself, or is what is named."""
        if self._entry_points is None:
            return
        for name, target in offered_by_packages(self._entry_points).items():
            found = loaded(target)
            if name not in self._elements and isinstance(found, type):
                self.register(name)(cast("T", found))


def _home(element: object) -> tuple[str, str]:
    """Where an element is defined; equal for one whose module was imported again after a failure."""
    return getattr(element, "__module__", ""), getattr(element, "__qualname__", repr(element))


def offered(name: str, known: Iterable[str], among: Message = THERE_IS, most: int | None = None) -> Message:
    """What was probably meant by a name that does not exist, else all that exist, at ``most`` so many.

    ``among``: the text that lists them as ``names``.
    """
    names = tuple(dict.fromkeys(known))
    offer = nearest(str(name)[:100], names)
    if offer is not None:
        return _('did you mean "{offer}"?', offer=offer)
    return among.format(names=_shown(names[:most])) if names else _("there is none")


def listed(name: str, known: Iterable[str], word: str = "there_is") -> Message:
    """What was probably meant, and all that exist; ``word``: ``there_is``, ``known`` or ``one_of``."""
    names = tuple(dict.fromkeys(known))
    offer = nearest(name[:100], names)
    if offer is not None:
        return LISTINGS[word][0].format(offer=offer, names=_shown(names))
    return LISTINGS[word][1].format(names=_shown(names)) if names else _("there is none")


def _shown(names: tuple[str, ...]) -> tuple[str, ...]:
    """The names as a sentence lists them, the first where they are many."""
    return names if len(names) <= MOST_SHOWN else (*names[:MOST_SHOWN], "…")


def no_such(noun: Message, name: str, known: Iterable[str]) -> Message:
    """The sentence for a name that does not exist, or is none."""
    return _(
        'there is no {noun} "{name}"; {hint}', code="names.no_such", noun=noun, name=name, hint=offered(name, known)
    )


def nearest(
    name: str, candidates: Mapping[str, object] | list[str] | tuple[str, ...], likeness: float = POSSIBLE
) -> str | None:
    """The candidate that looks most like ``name`` (capitals do not count), or means the same; None where none has
    this ``likeness``."""
    known = list(candidates)
    if len(known) > MOST_COMPARED:
        known = [text for text in known if text[:1].casefold() == name[:1].casefold()][:MOST_COMPARED]
    folded = {text.casefold(): text for text in reversed(known)}
    if name.casefold() in folded:
        return folded[name.casefold()]
    from difflib import get_close_matches

    same, share = nearest_in_meaning(name, known)
    misspelt = get_close_matches(name.casefold(), list(folded), n=1, cutoff=MISSPELT)
    if misspelt and share < 1.0:
        return folded[misspelt[0]]
    if share >= 0.5:
        return same
    within = [text for key, text in folded.items() if len(key) > 2 and name.casefold().startswith(key)]
    if within:
        return max(within, key=len)
    inside = [text for key, text in folded.items() if len(name) > 2 and key.startswith(name.casefold())]
    if inside:
        return min(inside, key=len)
    found = get_close_matches(name.casefold(), list(folded), n=1, cutoff=likeness)
    return folded[found[0]] if found else None
