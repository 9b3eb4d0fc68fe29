"""Which strokes are edges of polygons, as the outline of a leaf that is filled."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lsys_kit.geometry.scene import Floats, Polygons, Segments


def are_edges(segments: Segments, polygons: Polygons) -> NDArray[np.bool_]:
    """Which strokes are edges of polygons.

    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.turtle.space import trace_in_space
    >>> from lsys_kit.notation.read import read
    >>> leaf = trace_in_space(derive(read("axiom: F & { . F + (120) F } F"), 0)[0])
    >>> are_edges(leaf.segments, leaf.polygons).tolist()
    [False, True, True, False]
    """
    if not (len(polygons) and len(segments)):
        return np.zeros(len(segments), bool)
    points, following = polygons.points, np.arange(1, len(polygons.points) + 1)
    following[polygons.starts[1:] - 1] = polygons.starts[:-1]
    edges = np.concatenate([np.hstack([points, points[following]]), np.hstack([points[following], points])])
    return np.isin(_keys(segments.ends), _keys(edges))


def _keys(rows: Floats) -> NDArray[np.void]:
    """Rows of numbers as values that can be compared."""
    whole = np.ascontiguousarray(rows + 0.0)  # which makes no difference between 0 and -0
    return whole.view(np.dtype((np.void, whole.strides[0]))).ravel()
