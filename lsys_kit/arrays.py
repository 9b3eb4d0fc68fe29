"""numpy, loaded when an array is first needed: words of some thousand modules, nets and answers need none.

So the first word comes early, and the kit answers where there is no numpy, as in a browser's Python before it is fetched. What
needs arrays there raises the `ModuleNotFoundError` of numpy.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, TypeGuard

__all__ = ["arrays_pay", "is_array", "np"]

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray
else:

    class _Numpy:
        def __getattr__(self, name: str) -> object:
            found = getattr(import_module("numpy"), name)
            setattr(self, name, found)
            return found

    np = _Numpy()

TO_LOAD = 16
"""By what factor work must be larger for which numpy is loaded than work for which it is there."""


def arrays_pay(size: int, least: int) -> bool:
    """Whether work is quicker by arrays: work that is larger than the least size, or much larger where numpy must be loaded.

    >>> arrays_pay(64, 64), arrays_pay(64 * TO_LOAD + 1, 64)
    (False, True)
    """
    return size > least and (_is_loaded() or (size > TO_LOAD * least and _can_be_loaded()))


def is_array(given: object) -> TypeGuard[NDArray[np.generic]]:
    """Whether something is an array of numpy, which is not loaded for that.

    >>> is_array(np.arange(3)), is_array([0, 1, 2])
    (True, False)
    """
    return _is_loaded() and isinstance(given, np.ndarray)


def _is_loaded() -> bool:
    return sys.modules.get("numpy") is not None


@cache
def _can_be_loaded() -> bool:
    try:
        import_module("numpy")
    except ImportError:
        return False
    return True
