"""A headless Chromium that is told what to do over a pair of pipes (the DevTools protocol)."""
import base64
import json
import os
import shutil
import signal
import subprocess
import tempfile


class Browser:
    """Usable in a `with`; one page."""

    def __init__(self, program):
        self._profile = tempfile.mkdtemp(prefix='aisle_browser_')
        told, self._out = os.pipe()
        self._in, said = os.pipe()

        def plug():
            # Chromium reads commands from descriptor 3 and answers on 4.
            read, write = os.dup(told), os.dup(said)
            os.dup2(read, 3)
            os.dup2(write, 4)

        self._process = subprocess.Popen(
            [program, '--headless=new', '--no-sandbox', '--disable-gpu', '--no-first-run',
             '--disable-dev-shm-usage', '--remote-debugging-pipe',
             f'--user-data-dir={self._profile}', 'about:blank'],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            preexec_fn=plug, close_fds=False, start_new_session=True)
        os.close(told)
        os.close(said)
        self._buffer = b''
        self._number = 0
        self._session = None
        self.log = []  # what the page complained of
        target = self.call('Target.createTarget', url='about:blank')['targetId']
        self._session = self.call('Target.attachToTarget', targetId=target,
                                  flatten=True)['sessionId']
        for domain in ('Page', 'Runtime', 'Log'):
            self.call(domain + '.enable')

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self._out)
        os.killpg(self._process.pid, signal.SIGKILL)  # its children write into the profile as well
        self._process.wait()
        os.close(self._in)
        shutil.rmtree(self._profile, ignore_errors=True)

    def _message(self):
        while b'\0' not in self._buffer:
            more = os.read(self._in, 1 << 16)
            if not more:
                raise RuntimeError('the browser is gone')
            self._buffer += more
        text, self._buffer = self._buffer.split(b'\0', 1)
        return json.loads(text)

    def _await(self, wanted):
        while True:
            message = self._message()
            if message.get('method') == 'Log.entryAdded':
                self.log.append(message['params']['entry']['text'])
            if message.get('method') == 'Runtime.exceptionThrown':
                self.log.append(str(message['params']['exceptionDetails']))
            if wanted(message):
                return message

    def call(self, method, **params):
        self._number += 1
        number = self._number
        command = {'id': number, 'method': method, 'params': params}
        if self._session:
            command['sessionId'] = self._session
        os.write(self._out, json.dumps(command).encode() + b'\0')
        answer = self._await(lambda message: message.get('id') == number)
        if 'error' in answer:
            raise RuntimeError(f"{method}: {answer['error']['message']}")
        return answer['result']

    def open(self, url, width=1280, height=900, dark=False, scripts=True, media='',
             vision='none'):
        self.log.clear()
        self.call('Emulation.setDeviceMetricsOverride', width=width, height=height,
                  deviceScaleFactor=1, mobile=False)
        self.call('Emulation.setEmulatedVisionDeficiency', type=vision)
        self.call('Emulation.setEmulatedMedia', media=media, features=[
            {'name': 'prefers-color-scheme', 'value': 'dark' if dark else 'light'}])
        self.call('Emulation.setScriptExecutionDisabled', value=not scripts)
        self.call('Page.navigate', url=url)
        self._await(lambda message: message.get('method') == 'Page.loadEventFired')

    def ask(self, expression):
        """The value of an expression in the page; the test's own world, whatever the policy."""
        answer = self.call('Runtime.evaluate', expression=expression, returnByValue=True)
        if 'exceptionDetails' in answer:
            raise RuntimeError(f'{expression}: {answer["exceptionDetails"]}')
        return answer['result'].get('value')

    def middle_of(self, selector):
        """In pixels of the window, the element scrolled into observation."""
        element = f'document.querySelector({json.dumps(selector)})'
        self.ask(f'{element}.scrollIntoView({{block: "center"}})')
        box = self.ask(f'(r => [r.x + r.width / 2, r.y + r.height / 2])'
                       f'({element}.getBoundingClientRect())')
        return box

    def mouse(self, kind, at, **more):
        self.call('Input.dispatchMouseEvent', type=kind, x=at[0], y=at[1], **more)

    def click(self, selector):
        at = self.middle_of(selector)
        for kind in ('mousePressed', 'mouseReleased'):
            self.mouse(kind, at, button='left', clickCount=1)

    def follow(self, selector):
        """Clicks on what leads to another page, and waits for that page."""
        self.click(selector)
        self._await(lambda message: message.get('method') == 'Page.loadEventFired')

    def key(self, name):
        for kind in ('keyDown', 'keyUp'):
            self.call('Input.dispatchKeyEvent', type=kind, key=name, code=name,
                      windowsVirtualKeyCode={'Home': 36, 'End': 35, 'ArrowRight': 39}[name])

    def type(self, text):
        self.call('Input.insertText', text=text)

    def picture(self, whole=False):
        """PNG of what the window shows, or of the whole page."""
        return base64.b64decode(self.call('Page.captureScreenshot', format='png',
                                          captureBeyondViewport=whole)['data'])
