"""A cache of results, bounded by their bytes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Generic, TypeVar

from lsys_kit.budget import current

_K = TypeVar("_K")
_V = TypeVar("_V")


class Cache(Generic[_K, _V]):
    """Results that can be computed again: those used last are kept, as many as the limit of bytes has room for (LRU).

    size
        How many bytes a result takes.
    share
        What part of the limit there is room for.

    >>> from lsys_kit import limits
    >>> with limits(bytes=10):
    ...     cache = Cache(len)
    ...     for text in ("four", "five5", "six", "six"):
    ...         _ = cache.put(text, text)
    >>> cache.get("four"), cache.get("five5"), cache.get("six")
    (None, 'five5', 'six')
    """

    def __init__(self, size: Callable[[_V], int], share: float = 1.0) -> None:
        self._size, self._share = size, share
        self._found: dict[_K, _V] = {}
        self._bytes = 0

    def __iter__(self) -> Iterator[_K]:
        """The keys of what is kept; what was used last is the last one."""
        return iter(self._found)

    def get(self, key: _K) -> _V | None:
        found = self._found.pop(key, None)
        if found is not None:
            self._found[key] = found  # the last one in a dictionary was used last
        return found

    def found(self, key: _K, make: Callable[[], _V]) -> _V:
        """A result, made now if it is not kept."""
        known = self.get(key)
        return self.put(key, make()) if known is None else known

    def put(self, key: _K, result: _V) -> _V:
        if key in self._found:
            self._bytes -= self._size(self._found.pop(key))
        self._found[key] = result
        self._bytes += self._size(result)
        while self._bytes > current().bytes * self._share and len(self._found) > 1:
            self._bytes -= self._size(self._found.pop(next(iter(self._found))))
        return result
