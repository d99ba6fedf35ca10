"""A headless Chromium, driven over the DevTools protocol through pipes, with Python's standard library alone."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

NAMES = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]

# numbers and texts of keys that act by themselves
KEYS = {"Tab": (9, ""), "Enter": (13, "\r"), " ": (32, " "), "ArrowLeft": (37, ""), "ArrowUp": (38, ""), "ArrowRight": (39, ""), "ArrowDown": (40, "")}


def find():
    """The path of Chromium, or None."""
    return next((path for path in map(shutil.which, [os.environ.get("CHROMIUM", ""), *NAMES]) if path), None)


class Browser:
    """One browser with one page. `options` are added to its command line; an answer takes at most `patience` seconds."""

    def __init__(self, path, width=1400, height=1000, touch=False, gpu=False, options=(), patience=60):
        self.patience = patience
        self.profile = tempfile.mkdtemp()
        to_child, self.commands = os.pipe()
        self.answers, from_child = os.pipe()

        def wire():
            # Chromium reads commands from descriptor 3, and writes answers to 4
            a, b = os.dup(to_child), os.dup(from_child)
            os.dup2(a, 3)
            os.dup2(b, 4)

        arguments = ["--headless=new", "--no-sandbox", "--no-first-run", "--disable-extensions", "--disable-background-networking"]
        arguments += ["--hide-scrollbars", "--mute-audio", "--remote-debugging-pipe", f"--user-data-dir={self.profile}", *([] if gpu else ["--disable-gpu"]), *options, "about:blank"]
        self.process = subprocess.Popen([path, *arguments], close_fds=False, preexec_fn=wire, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_child)
        os.close(from_child)
        self.buffer, self.number, self.events = b"", 0, []
        target = self.send("Target.getTargets")["targetInfos"]
        page = next(t for t in target if t["type"] == "page")
        self.session = self.send("Target.attachToTarget", targetId=page["targetId"], flatten=True)["sessionId"]
        for domain in ["Page", "Runtime"]:
            self.call(f"{domain}.enable")
        # processor time, whatever else the machine does
        self.call("Performance.enable", timeDomain="threadTicks")
        self.resize(width, height, touch)

    def close(self):
        self.process.terminate()
        self.process.wait(20)
        os.close(self.commands)
        os.close(self.answers)
        shutil.rmtree(self.profile, ignore_errors=True)

    def receive(self, deadline):
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.answers], [], [], max(0, deadline - time.monotonic()))
            part = os.read(self.answers, 1 << 20) if ready else b""
            if not part:
                raise RuntimeError("the browser does not answer" if not ready else "the browser has ended")
            self.buffer += part
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def send(self, method, session=None, **parameters):
        self.number += 1
        message = {"id": self.number, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        os.write(self.commands, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + self.patience
        while True:
            answer = self.receive(deadline)
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def call(self, method, **parameters):
        return self.send(method, self.session, **parameters)

    def resize(self, width, height, touch=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=touch)
        self.call("Emulation.setTouchEmulationEnabled", enabled=touch)

    def evaluate(self, expression):
        """The value of an expression in the page; promises are awaited."""
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            details = result["exceptionDetails"]
            raise RuntimeError(f"{expression}: {details.get('exception', {}).get('description', details['text'])}")
        return result["result"].get("value")

    def open(self, url, ready="window.playground"):
        """Opens an address and waits until it is loaded, and its scripts are ready."""
        # an address that differs after the # alone would not be loaded again
        self.call("Page.navigate", url="about:blank")
        self.wait("location.href === 'about:blank'")
        self.call("Page.navigate", url=url)
        self.wait(f"location.href !== 'about:blank' && document.readyState === 'complete' && {ready}")

    def wait(self, condition, seconds=30):
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if self.evaluate(f"Boolean({condition})"):
                return
            time.sleep(0.05)
        raise RuntimeError(f"after {seconds} s it is not so that {condition}")

    def settle(self):
        """Waits for the frame that shows the last change."""
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")

    def mouse(self, kind, x, y, buttons=0):
        button = "left" if buttons or kind == "mouseReleased" else "none"
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, buttons=buttons, clickCount=1)

    def drag(self, start, end, steps=8):
        (x, y), (a, b) = start, end
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, 1)
        for k in range(1, steps + 1):
            self.mouse("mouseMoved", x + (a - x) * k / steps, y + (b - y) * k / steps, 1)
        self.mouse("mouseReleased", a, b)
        self.settle()

    def click(self, selector):
        self.evaluate(f"document.querySelector({json.dumps(selector)}).scrollIntoView({{block: 'center'}})")
        self.settle()
        x, y = self.evaluate(f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; }})()")
        self.mouse("mousePressed", x, y, 1)
        self.mouse("mouseReleased", x, y)
        self.settle()

    def touch(self, points):
        kind = "touchEnd" if not points else "touchMove"
        self.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y} for x, y in points])

    def key(self, name, shift=False):
        for kind in ["keyDown", "keyUp"]:
            # without its text, a key presses no button; without its number, Tab moves nothing
            text = {"text": KEYS[name][1]} if kind == "keyDown" and name in KEYS and KEYS[name][1] else {}
            number = {"windowsVirtualKeyCode": KEYS[name][0]} if name in KEYS else {}
            self.call("Input.dispatchKeyEvent", type=kind, key=name, code=name, modifiers=8 * shift, **number, **text)
        self.settle()

    def choose(self, identifier, value):
        """Chooses in a select, or moves a slider, as a hand would: with the events."""
        self.evaluate(
            f"(() => {{ const e = document.getElementById({json.dumps(identifier)}); e.value = {json.dumps(value)};"
            " e.dispatchEvent(new Event('input', {bubbles: true})); e.dispatchEvent(new Event('change', {bubbles: true})); })()"
        )
        self.settle()

    def box(self, selector):
        """Where an element is on the page: left, top, width and height."""
        return self.evaluate(f"(() => {{ const b = document.querySelector({json.dumps(selector)}).getBoundingClientRect(); return [b.x + scrollX, b.y + scrollY, b.width, b.height]; }})()")

    def screenshot(self, selector=None, whole=True):
        """PNG bytes of the whole page, of an element, or of what the window shows."""
        clip = {"captureBeyondViewport": whole}
        if selector:
            clip["clip"] = dict(zip(["x", "y", "width", "height"], self.box(selector)), scale=1)
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", **clip)["data"])

    def busy(self):
        """Seconds of processor time that the page's thread has taken."""
        return next(m["value"] for m in self.call("Performance.getMetrics")["metrics"] if m["name"] == "TaskDuration")

    def errors(self):
        """What the page's scripts complained of."""
        return [event["params"] for event in self.events if event.get("method") in ("Runtime.exceptionThrown",)]
