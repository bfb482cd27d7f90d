"""Chromium without a screen, by its debugging protocol through a pipe."""

import base64
import fcntl
import io
import json
import os
import select
import subprocess
import time

import numpy as np
from matplotlib import image

_flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking", "--disable-component-update",
          "--disable-sync", "--window-size=800,800", "--remote-debugging-pipe"]

_patience = 60  #: seconds


class Browser:
    def __init__(self, profile):
        to_read, self._out = os.pipe()
        self._in, to_write = os.pipe()

        def take():  # 3 and 4 of the browser; copies first, as the ends may have these numbers
            read, write = (fcntl.fcntl(end, fcntl.F_DUPFD, 10) for end in (to_read, to_write))
            os.dup2(read, 3)
            os.dup2(write, 4)

        self._process = subprocess.Popen(["chromium", *_flags, f"--user-data-dir={profile}", "about:blank"], preexec_fn=take, close_fds=False,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        self._buffer, self._number, self.notes = b"", 0, []

    def call(self, method, session=None, **given):
        """Result of a method; what else the browser says meanwhile is noted."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": given, **({"sessionId": session} if session else {})}
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self._buffer:
                assert select.select([self._in], [], [], _patience)[0], f"no answer to {method}"
                read = os.read(self._in, 1 << 20)
                assert read, "the browser has ended"
                self._buffer += read
            text, _, self._buffer = self._buffer.partition(b"\0")
            said = json.loads(text)
            if said.get("id") == self._number:
                assert "error" not in said, said
                return said["result"]
            self.notes.append(said)

    def visit(self, address):
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        tab = Tab(self, self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"])
        for domain in ("Page", "Runtime", "Network"):
            tab.call(f"{domain}.enable")
        tab.call("Page.navigate", url=address)
        tab.wait_for("location.protocol !== 'about:' && document.readyState === 'complete'")
        return tab

    def __enter__(self):
        return self

    def __exit__(self, *reason):
        self._process.kill()
        self._process.wait()
        os.close(self._in)
        os.close(self._out)


class Tab:
    def __init__(self, browser, session):
        self._browser, self._session = browser, session

    def call(self, method, **given):
        return self._browser.call(method, self._session, **given)

    def value(self, expression):
        return self.call("Runtime.evaluate", expression=expression, returnByValue=True)["result"].get("value")

    def wait_for(self, expression):
        self.wait_until(lambda: self.value(expression) is True, expression)

    def wait_until(self, condition, said=""):
        end = time.monotonic() + _patience
        while not condition():
            assert time.monotonic() < end, f"not within a minute: {said}"
            time.sleep(0.05)

    def mouse(self, kind, x, y):
        pressed = kind != "mouseMoved"
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if pressed else "none", clickCount=int(pressed))

    def picture(self):
        """What is seen, (height, width, 3)."""
        png = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        return (image.imread(io.BytesIO(png), format="png")[:, :, :3] * 255).astype(np.uint8)

    @property
    def asked_for(self):
        """Addresses of other hosts that the page has asked for."""
        asked = [note["params"]["request"]["url"] for note in self._browser.notes if note.get("method") == "Network.requestWillBeSent"]
        return [address for address in asked if address.split(":")[0] not in ("file", "data", "blob", "about")]
