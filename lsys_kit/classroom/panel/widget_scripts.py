"""The scripts of widgets, of which a browser has each once.

A browser never forgets a script that it has loaded, and Jupyter loads that of each widget anew, however often its cell is run.
So what it loads is short (`once.js`); the script itself is in a widget of its own, one in a kernel, from which a page takes it
once.
"""

from __future__ import annotations

import traitlets

from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.widget import KitWidget, Unfinalized, Widget, widget_serialization


class WidgetScript(Unfinalized, Widget):  # type: ignore[misc]
    """A script and its style, as a browser has them for all widgets that they are of."""

    script = traitlets.Unicode().tag(sync=True)
    sheet = traitlets.Unicode().tag(sync=True)
    style = traitlets.Unicode().tag(sync=True)


_scripts: dict[tuple[str, str], WidgetScript] = {}


def script_of(script: str, sheet: str) -> WidgetScript:
    """The script of a name with a style; another where somebody has closed it.

    >>> script_of("widget", "panels") is script_of("widget", "panels")
    True
    """
    known = _scripts.get((script, sheet))
    if known is None or known.comm is None:
        known = _scripts[script, sheet] = WidgetScript(script=compact(script), sheet=sheet, style=style(sheet))
    return known


class ScriptedWidget(KitWidget):
    """A widget with one of the kit's scripts, and one of its styles."""

    _script_name, _style_name = "", "panels"
    _esm = compact("once")
    _script = traitlets.Instance(WidgetScript).tag(sync=True, **widget_serialization)

    @traitlets.default("_script")
    def _own_script(self) -> WidgetScript:
        return script_of(self._script_name, self._style_name)
