"""A headless Firefox, driven by its own protocol, Marionette, with Python's standard library alone."""

import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time

NAMES = ["firefox", "firefox-esr"]


def find():
    """The path of Firefox, or None."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Firefox:
    """One browser with one page."""

    def __init__(self, path):
        self.profile = tempfile.mkdtemp()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        with open(f"{self.profile}/user.js", "w") as preferences:
            preferences.write(f'user_pref("marionette.port", {port});\n')
        arguments = ["--headless", "--no-remote", "--marionette", "--profile", self.profile]
        self.process = subprocess.Popen([path, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while True:
            try:
                self.socket = socket.create_connection(("127.0.0.1", port), 60)
                break
            except OSError:
                if time.monotonic() > deadline or self.process.poll() is not None:
                    raise
                time.sleep(0.1)
        self.buffer, self.number = b"", 0
        self.receive()  # it says what it is first
        self.call("WebDriver:NewSession", {})

    def close(self):
        self.process.terminate()
        self.process.wait(30)
        self.socket.close()
        shutil.rmtree(self.profile, ignore_errors=True)

    def receive(self):
        """A message: its length, a colon, and JSON."""
        while b":" not in self.buffer or len(self.buffer) < int(self.buffer.split(b":")[0]) + self.buffer.index(b":") + 1:
            part = self.socket.recv(1 << 20)
            if not part:
                raise RuntimeError("Firefox has ended")
            self.buffer += part
        size, rest = self.buffer.split(b":", 1)
        self.buffer = rest[int(size) :]
        return json.loads(rest[: int(size)])

    def call(self, command, parameters):
        self.number += 1
        message = json.dumps([0, self.number, command, parameters]).encode()
        self.socket.sendall(b"%d:%s" % (len(message), message))
        _, _, error, result = self.receive()
        if error:
            raise RuntimeError(f"{command}: {error['message']}")
        return result

    def resize(self, width, height):
        self.call("WebDriver:SetWindowRect", {"width": width, "height": height})

    def evaluate(self, expression):
        """The value of an expression in the page; promises are awaited."""
        return self.call("WebDriver:ExecuteScript", {"script": f"return {expression}", "args": [], "sandbox": None})["value"]

    def open(self, url):
        self.call("WebDriver:Navigate", {"url": url})
        deadline = time.monotonic() + 30
        while not self.evaluate("Boolean(window.playground)"):
            if time.monotonic() > deadline:
                raise RuntimeError(f"the page does not start: {self.evaluate('document.body.innerText')}")
            time.sleep(0.05)

    def settle(self):
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def screenshot(self, selector=None):
        """PNG bytes of the whole page, or of an element."""
        what = {"full": True}
        if selector:
            found = self.call("WebDriver:FindElement", {"using": "css selector", "value": selector})["value"]
            what = {"id": next(iter(found.values()))}
        return base64.b64decode(self.call("WebDriver:TakeScreenshot", what)["value"])
