"""Kernels that start at once: each is forked from one process that has imported the kit, and is else as new as any other.

    python tests/notebooks/kernels.py ADDRESS

waits at this address of the machine for requests of kernels. What Jupyter starts as a kernel (`STAND_IN`) asks there for a
fork, passes on the signals that it gets, and ends with it; where the stand-in is gone, the fork ends.
"""

from __future__ import annotations

import contextlib
import gc
import json
import os
import random
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

ARE_FORKED = sys.platform == "linux"
"""Elsewhere a process that has imported much cannot be forked, or not safely: there kernels are started as ever."""
SECONDS = 60
"""How long the imports may take on a slow machine."""
MOST = 1 << 20
"""Bytes of a request: a command, and the environment of a process."""
STAND_IN = """
import json, os, signal, socket, sys
line = socket.socket(socket.AF_UNIX)
line.connect(sys.argv[1])
socket.send_fds(line, [json.dumps([sys.argv[2:], os.getcwd(), dict(os.environ)]).encode()], [0, 1, 2])
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, lambda number, _: line.send(bytes([number])))
line.recv(1)
"""


@contextlib.contextmanager
def forked(folder: Path) -> Iterator[Path]:
    """A folder for `JUPYTER_PATH`, in which "python3" is a kernel that is forked."""
    address, spec = folder / "kernels.socket", folder / "kernels" / "python3" / "kernel.json"
    spec.parent.mkdir(parents=True)
    argv = [sys.executable, "-I", "-S", "-c", STAND_IN, str(address), "-f", "{connection_file}"]
    spec.write_text(json.dumps({"argv": argv, "display_name": "Python 3 (ipykernel)", "language": "python"}))
    with subprocess.Popen([sys.executable, __file__, str(address)], stdin=subprocess.DEVNULL) as server:
        try:
            _await(address, server)
            yield folder
        finally:
            server.terminate()


def _await(address: Path, server: subprocess.Popen[bytes]) -> None:
    end = time.monotonic() + SECONDS
    while not address.exists():
        if server.poll() is not None or time.monotonic() > end:
            raise RuntimeError("The process from which kernels are forked did not start")
        time.sleep(0.02)


def serve(address: Path) -> None:
    """Fork a kernel for each stand-in that asks for one."""
    import_what_notebooks_use()
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # so that none of the forks stays as a zombie
    door = socket.socket(socket.AF_UNIX)
    door.bind(f"{address}.new")
    door.listen(64)
    Path(f"{address}.new").rename(address)
    while True:
        line, _ = door.accept()
        request, standard, _, _ = socket.recv_fds(line, MOST, 3)
        if os.fork() == 0:
            door.close()
            be_a_kernel(line, standard, *json.loads(request))
        line.close()
        for each in standard:
            os.close(each)


def import_what_notebooks_use() -> None:
    """Import the kit with all its names, and what runs cells; what is there stays where it is in memory."""
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"  # as a kernel does, before matplotlib is imported
    import ipykernel.ipkernel
    import ipykernel.kernelapp  # noqa: F401
    import matplotlib_inline.backend_inline  # noqa: F401

    import lsys_kit
    import lsys_kit.classroom.site.showing

    for name in lsys_kit.__all__:
        getattr(lsys_kit, name)
    gc.collect()
    gc.freeze()


def be_a_kernel(line: socket.socket, standard: list[int], argv: list[str], folder: str, environment: dict[str, str]) -> None:
    """Be what the stand-in would have become: its command, its folder, its environment, its streams and its signals."""
    from ipykernel.kernelapp import IPKernelApp

    for number, each in enumerate(standard):
        os.dup2(each, number)
        os.close(each)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    signal.signal(signal.SIGCHLD, signal.SIG_DFL)
    random.seed()
    threading.Thread(target=pass_on_signals, args=(line,), daemon=True).start()
    try:
        IPKernelApp.launch_instance(argv, parent_handle=os.getppid())
    finally:
        os._exit(0)


def pass_on_signals(line: socket.socket) -> None:
    """Send this process the signals that its stand-in gets; end with it."""
    while number := line.recv(1):
        os.kill(os.getpid(), number[0])
    os._exit(0)


if __name__ == "__main__":
    sys.path.pop(0)  # the folder of this file
    serve(Path(sys.argv[1]))
