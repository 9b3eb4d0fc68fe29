"""A kernel that was forked is like one that was started: it has its own folder, is interrupted, restarted and ended."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from jupyter_client.blocking.client import BlockingKernelClient
from jupyter_client.manager import KernelManager, start_new_kernel

from tests.notebooks.rebuild import notebooks, rebuilt

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("kernels")]
PATIENCE = 60


@pytest.fixture
def running(tmp_path: Path) -> Iterator[tuple[KernelManager, BlockingKernelClient]]:
    manager, client = start_new_kernel(kernel_name="python3", cwd=str(tmp_path))
    yield manager, client
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def said(client: BlockingKernelClient, source: str) -> str:
    """What a cell says, or the name of its error."""
    heard: list[str] = []

    def hear(message: dict) -> None:
        heard.append(message["content"].get("text") or message["content"].get("ename") or "")

    client.execute_interactive(source, timeout=PATIENCE, output_hook=hear)
    return "".join(heard).strip()


def test_it_has_its_own_folder_and_no_names(running, tmp_path: Path) -> None:
    _, client = running
    assert said(client, "import os; print(os.getcwd())") == str(tmp_path)
    assert said(client, "import sys; print(sys.executable, '' in sys.path)") == f"{sys.executable} True"
    assert said(client, "print(__name__, 'derive' in globals())") == "__main__ False"


def test_it_is_interrupted_and_goes_on(running) -> None:
    manager, client = running
    asked = client.execute("import time\nprint('begun')\ntime.sleep(600)", stop_on_error=False)
    while client.get_iopub_msg(timeout=PATIENCE)["content"].get("text") != "begun\n":
        pass
    manager.interrupt_kernel()
    while (reply := client.get_shell_msg(timeout=PATIENCE))["parent_header"]["msg_id"] != asked:
        pass  # on a busy machine a kernel is asked more than once who it is
    assert reply["content"]["ename"] == "KeyboardInterrupt"
    assert said(client, "print(6 * 7)") == "42"


def test_a_new_one_knows_nothing_of_the_one_before_which_is_gone(running) -> None:
    manager, client = running
    before = int(said(client, "import os\nknown = 1\nprint(os.getpid())"))
    manager.restart_kernel(now=True)
    client.wait_for_ready(timeout=PATIENCE)
    assert said(client, "known") == "NameError"
    with pytest.raises(ProcessLookupError):
        os.kill(before, 0)


def test_a_lesson_shows_the_same_in_a_kernel_that_was_started(monkeypatch: pytest.MonkeyPatch) -> None:
    lesson = next(path for path in notebooks() if path.parent.name == "notebooks")
    monkeypatch.delenv("JUPYTER_PATH", raising=False)
    assert rebuilt(lesson) == lesson.read_bytes().decode()
