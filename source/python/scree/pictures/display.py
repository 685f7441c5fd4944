# SPDX-License-Identifier: LGPL-2.1-or-later
"""A window of VTK that no screen shows. Debian's VTK draws by an X server only: where none is there, Xvfb is started for the time of the drawing."""

import contextlib
import os
import shutil
import subprocess

from vtkmodules import vtkRenderingOpenGL2  # what draws for vtkRenderingCore
from vtkmodules.vtkRenderingCore import vtkRenderWindow

BACKEND = vtkRenderingOpenGL2.__name__


@contextlib.contextmanager
def offscreen_window(width, height):
    """A vtkRenderWindow without a screen. Throws a ValueError if nothing can draw."""
    with contextlib.ExitStack() as stack:
        window = vtkRenderWindow()
        if window.IsA("vtkXOpenGLRenderWindow"):
            stack.enter_context(_x_server())
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(0)
        window.SetSize(width, height)
        # Before the server ends: it would end this program, too.
        stack.callback(window.Finalize)
        yield window


@contextlib.contextmanager
def _x_server():
    """Xvfb, if it is installed; else the display of the desktop."""
    if shutil.which("Xvfb") is None:
        if not os.environ.get("DISPLAY"):
            raise ValueError("pictures of 3D runs need an X server. Install Xvfb; in Debian: package xvfb")
        yield
        return
    before = os.environ.get("DISPLAY")
    read_end, write_end = os.pipe()
    with subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "64x64x24", "-nolisten", "tcp"],
                          pass_fds=[write_end], stderr=subprocess.DEVNULL) as server:
        os.close(write_end)
        with os.fdopen(read_end) as answer:
            number = answer.readline().strip()
        if not number:
            raise ValueError("Xvfb does not start. Does `Xvfb :99` start in a terminal?")
        os.environ["DISPLAY"] = ":" + number
        try:
            yield
        finally:
            server.terminate()
            os.environ.pop("DISPLAY")
            if before is not None:
                os.environ["DISPLAY"] = before
