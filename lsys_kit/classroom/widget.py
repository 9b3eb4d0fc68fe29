"""What all widgets of the kit share: what a page without a kernel shows of them, and how they end."""

from __future__ import annotations

try:
    from anywidget import AnyWidget
    from ipywidgets import Widget, widget_serialization
except ModuleNotFoundError:  # in a page, where its scripts show what a widget would
    from lsys_kit.classroom.unseen import AnyWidget, Widget, widget_serialization

__all__ = ["KitWidget", "Unfinalized", "Widget", "widget_serialization"]


class Unfinalized:
    """A widget that is not closed when it is collected: the open ones are kept by a registry, so it has been closed, or an
    interrupt came while it was made; of half a widget nothing can be closed."""

    __del__ = staticmethod(tuple)  # does nothing, and has no bytecode of its own in which an interrupt would be swallowed


class KitWidget(Unfinalized, AnyWidget):  # type: ignore[misc]
    """A widget that is displayed by its script, and stored as text."""

    def _stored(self) -> dict[str, object]:
        """What a page without a kernel shows, by media types."""
        return {"text/plain": repr(self)}

    def _repr_mimebundle_(self, **options: object) -> dict[str, object]:
        bundle = super()._repr_mimebundle_(**options)
        return {**dict(bundle[0] if isinstance(bundle, tuple) else bundle or {}), **self._stored()}

    def close(self) -> None:
        self.layout.close()
        super().close()
