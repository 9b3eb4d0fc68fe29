"""numpy, loaded when an array is first needed: words of some thousand modules, nets and answers need none.

So the first word comes early, and the kit answers where there is no numpy, as in a browser's Python before it is fetched. What
needs arrays there raises the `ModuleNotFoundError` of numpy.
"""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, TypeGuard

__all__ = ["has_arrays", "is_array", "np"]

if TYPE_CHECKING:
    from typing import Any

    import numpy as np
    from numpy.typing import NDArray
else:

    class _Numpy:
        def __getattr__(self, name: str) -> object:
            found = getattr(import_module("numpy"), name)
            setattr(self, name, found)
            return found

    np = _Numpy()


@cache
def has_arrays() -> bool:
    """Whether numpy can be loaded; it is loaded now.

    >>> has_arrays()
    True
    """
    try:
        import_module("numpy")
    except ImportError:
        return False
    return True


def is_array(given: object) -> TypeGuard[NDArray[Any]]:
    """Whether something is an array of numpy, which is not loaded for that.

    >>> is_array(np.arange(3)), is_array([0, 1, 2])
    (True, False)
    """
    return sys.modules.get("numpy") is not None and isinstance(given, np.ndarray)
