"""What the table says of an action is what the turtles do, for every command of every dialect."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from lsys_kit import derive, limits
from lsys_kit.geometry.turtle.commands import ACTIONS, COMMAND_TABLE, COMMANDS, Effect, Instruction, commands_of, in_plane
from lsys_kit.geometry.turtle.plane import PLANE_HANDLERS, place_path, trace
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS, SpaceTurtle, operand, trace_in_space
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem, Production
from tests.geometry.test_instancing import agree, draw_all_instanced

EVERY_COMMAND = [(turtle, symbol) for turtle, column in COMMANDS.items() for symbol, commands in column.items() if commands]
STROKE = {
    turtle: next(symbol for symbol, commands in column.items() if commands and commands[0].action == "draw")
    for turtle, column in COMMANDS.items()
}
PITCH = {"abop": "&", "grogra": "RL"}
POLYGON = [Pattern(symbol) for symbol in "{F+F.+F}"]
APEX, BUD = Pattern("apex"), Pattern("bud")


def phrases(turtle: str, symbol: str) -> st.SearchStrategy[list[Pattern]]:
    """A command, with what belongs to it; right angles among its arguments, so that a roll may stay in the plane."""
    stroke = Pattern(STROKE[turtle])
    if symbol in "[](){.}":
        found = {"(": "()", ")": "()"}.get(symbol, "[]")
        return st.just(POLYGON if symbol in "{.}" else [Pattern(found[0]), stroke, Pattern(found[1])])
    scales = COMMANDS[turtle][symbol][0].argument not in ("", "all", "more", "less")  # but not beyond what can be drawn
    few = st.sampled_from((0, Fraction(1, 2), 1) if scales else (0, 2, 3, 20, 90, 180)).map(Number)
    values = st.lists(few, min_size=3 * (symbol == "@M"), max_size={"@M": 3, "@B": 2}.get(symbol, 1))
    named = [Pattern("leaf")] if symbol == "~" else []
    return values.map(lambda arguments: [Pattern(symbol, tuple(arguments)), *named])


@st.composite
def successors(draw: st.DrawFn, turtle: str, symbol: str) -> tuple[Pattern, ...]:
    """A word with a command in it, between strokes, turns, branches and apices."""
    stroke = Pattern(STROKE[turtle])
    branch = [Pattern("["), Pattern("+"), APEX, Pattern("]")]
    others = st.lists(st.sampled_from(([stroke], [Pattern("+")], [APEX], [BUD], branch)), max_size=2)
    phrase = [stroke, Pattern("+"), *draw(phrases(turtle, symbol)), stroke]
    return tuple(module for part in (*draw(others), phrase, *draw(others)) for module in part)


@st.composite
def systems(draw: st.DrawFn, turtle: str, symbol: str) -> LSystem:
    """A system whose axiom and rules contain a command, in the plane or in space."""
    pitch = [Pattern(PITCH[turtle], (Number(40),))] if turtle in PITCH and draw(st.booleans()) else []
    word = successors(turtle, symbol)
    return LSystem(
        (*pitch, *draw(word), APEX),
        tuple(Production((apex,), draw(word)) for apex in (APEX, BUD)),
        turtle=turtle,
        angle=draw(st.sampled_from((90, 25))),
    )


def check_drawings(system: LSystem) -> None:
    """Module by module in the plane and in space, and put together from instances: all drawings of a system are the same."""
    with limits(modules=100_000):
        words = derive(system, 3)
        assume(max(words.lengths) < 300)
    whole, instanced = trace_in_space(words[-1]), draw_all_instanced(system, 3)
    if in_plane(system):
        flat = place_path(trace(words[-1]), float(system.angle), float(system.heading))
        near = 1e-9 * max(1.0, *map(abs, (*whole.corners[0], *whole.corners[1])))
        assert whole.segments.ends[:, [1, 4]] == pytest.approx(0, abs=near)
        for found, expected in (
            (flat.segments.points, whole.segments.points),
            (flat.polygons.points, whole.polygons.points),
            (flat.discs.centres, whole.discs.centres),
        ):
            assert found == pytest.approx(expected[:, [0, 2]], rel=0, abs=near)
        whole = flat
    assert (instanced is not None) == all(command.instanceable for command, _ in commands_of(system))
    if instanced is not None:
        agree(instanced, whole)


@pytest.mark.slow
@pytest.mark.parametrize(("turtle", "symbol"), EVERY_COMMAND)
@settings(max_examples=15)
@given(data=st.data())
def test_every_way_of_drawing_a_command_gives_the_same_picture(turtle: str, symbol: str, data: st.DataObject) -> None:
    check_drawings(data.draw(systems(turtle, symbol)))


def test_the_turtles_handle_every_action() -> None:
    assert SPACE_HANDLERS.keys() == ACTIONS.keys()
    assert PLANE_HANDLERS.keys() >= {name for name, effects in ACTIONS.items() if Effect.LEAVES_PLANE not in effects}
    assert PLANE_HANDLERS.keys() <= ACTIONS.keys()


def test_every_command_is_an_action_of_the_table() -> None:
    commands = [command for row in COMMAND_TABLE for command in row.commands]
    assert {name for command in commands for name in (command.action, command.bare) if name} <= ACTIONS.keys()


def turtle_after(*names: str) -> SpaceTurtle:
    """A turtle in space after some actions."""
    turtle = SpaceTurtle(((0.6, 0.0, 0.8), (0.0, 1.0, 0.0), (-0.8, 0.0, 0.6), 0), 1.0)
    turtle.take_look(LSystem((), ()))
    turtle.patches = {1.0: {(row, column): (float(row), float(column), 0.0) for row in range(4) for column in range(4)}}
    for name in names:
        SPACE_HANDLERS[name](turtle, operand(Instruction(name, 0.0, 30.0, (1.0, 2.0, 3.0), "L", "leaf"), 90.0))
    return turtle


@pytest.mark.parametrize("action", ACTIONS)
def test_an_action_does_what_the_table_says(action: str) -> None:
    effects, way = ACTIONS[action], ("begin polygon", "draw", "push", "turn", "draw", "draw", "expect surface")
    way += ("begin cylinder",) * action.endswith("cylinder")
    before, after = turtle_after(*way), turtle_after(*way, action)
    assert (before.position != after.position) == (Effect.MOVES in effects)
    assert (before.orientation != after.orientation) == (Effect.TURNS in effects)
    assert (len(after.stack) - len(before.stack)) == (Effect.OPENS in effects) - (Effect.CLOSES in effects)
    shapes = (sum(map(len, (turtle.strokes, turtle.outlines, turtle.rounds, turtle.labels))) for turtle in (before, after))
    assert (len(set(shapes)) == 2 or action.startswith("move")) == (Effect.VISIBLE in effects)
