"""Somebody who is told of a class, and may not read what is told."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import Mapping

MOST_UNREAD = 500
"""Who has not read so many messages is dropped."""


class Audience:
    """Somebody who is told of a class: what was acknowledged, and the last state; older states are not sent."""

    def __init__(self) -> None:
        self._messages: deque[str] = deque()
        self._state: str | None = None
        self._last_state = ""
        self._sending = False

    async def send_text(self, text: str) -> None:
        """Send a text, and wait until there is room for the next.

        Raises
        ------
        OSError, TimeoutError
            Nobody is there any more, or nobody reads.
        """
        raise NotImplementedError

    def drop(self) -> None:
        """Let go of somebody who does not read."""
        raise NotImplementedError

    def leave(self) -> None:
        """Let go of somebody who has come again."""
        self.drop()

    def show(self, state: str) -> None:
        """Send a state, in place of one that has not been sent yet."""
        if state != self._last_state:
            self._state = state
            self._send_soon()

    def say(self, message: Mapping[str, object]) -> None:
        """Send a message; who does not read is dropped."""
        self._messages.append(json.dumps(message))
        if len(self._messages) > MOST_UNREAD:
            self.drop()
        else:
            self._send_soon()

    def _send_soon(self) -> None:
        if not self._sending:
            self._sending = True
            asyncio.get_running_loop().create_task(self._send())

    async def _send(self) -> None:
        try:
            while self._messages or self._state is not None:
                if self._messages:
                    text = self._messages.popleft()
                else:
                    text, self._state = self._state or "", None
                    self._last_state = text
                await self.send_text(text)
        except TimeoutError:
            self.drop()
        except OSError:
            pass
        finally:
            self._sending = False
