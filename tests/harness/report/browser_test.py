#!/usr/bin/env python3
"""A report as people meet it: clicked through in headless Chromium, light and dark, with scripts,
without, and under the policy that Jenkins puts on artifacts. Skips where Chromium is absent.

usage: browser_test.py WRITE_NIGHT
"""
import functools
import http.server
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

from browser import Browser

STRICT = "default-src 'none'; img-src 'self'; style-src 'self'"
CHROMIUM = shutil.which('chromium')


class Server(http.server.SimpleHTTPRequestHandler):
    """Files below /strict/ come under the strict policy, the same ones below /plain/ without."""

    def do_GET(self):
        if self.path != '/favicon.ico':  # browsers ask for one; a report has none
            return super().do_GET()
        self.send_response(204)
        return self.end_headers()

    def translate_path(self, path):
        return super().translate_path('/' + path.split('/', 2)[-1])

    def end_headers(self):
        if self.path.startswith('/strict/'):
            self.send_header('Content-Security-Policy', STRICT)
        super().end_headers()

    def log_message(self, *_):
        pass


class ReportInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='aisle_night_')
        subprocess.run([WRITE_NIGHT, cls.folder, '3', '3'], check=True)
        handler = functools.partial(Server, directory=cls.folder)
        cls.server = http.server.ThreadingHTTPServer(('127.0.0.1', 0), handler)
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()
        cls.root = f'http://127.0.0.1:{cls.server.server_port}'
        cls.browser = Browser(CHROMIUM)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.server.shutdown()
        cls.server.server_close()
        shutil.rmtree(cls.folder)

    def open(self, page, policy='plain', **how):
        self.browser.open(f'{self.root}/{policy}/{page}', **how)
        return self.browser

    def column(self, table, index):
        return self.browser.ask(
            f"[...document.querySelector('{table}').rows].filter(r => r.cells[0].tagName === 'TD' "
            f"&& !r.hidden).map(r => r.cells[{index}].textContent)")

    def test_a_click_on_a_heading_sorts_and_the_next_turns_it_round(self):
        page = self.open('index.html')
        table = '.wide table'
        page.click(f'{table} th:nth-child(3)')
        rising = [float(cell) for cell in self.column(table, 2)]
        self.assertEqual(rising, sorted(rising))
        self.assertGreater(len(rising), 2)
        page.click(f'{table} th:nth-child(3)')
        self.assertEqual([float(cell) for cell in self.column(table, 2)], rising[::-1])
        self.assertEqual(page.log, [])

    def test_words_in_the_box_leave_the_rows_that_hold_them(self):
        page = self.open('scene_paper.scene1_live.html')
        page.click('details summary')
        page.click('details input.filter')
        page.type('ate rmse')
        self.assertEqual(self.column('details table', 0), ['ate_live_rmse_m', 'ate_rmse_m',
                                                           'ate_rot_rmse_deg'])

    def test_the_pointer_on_a_chart_shows_the_values_there(self):
        page = self.open('scene_paper.scene1_live.html')
        page.mouse('mouseMoved', page.middle_of('svg rect.panel'))
        said = page.ask("document.querySelector('.readout').textContent")
        self.assertRegex(said, r'error of the live track \[cm\]: orbslam2 [\d.]+, oracle [\d.]+')
        self.assertRegex(said, r'pixels that move \[%\]: [\d.]+')
        self.assertRegex(said, r'all [\d.]+, parallax [\d.]+, blur [\d.]+')

    def test_the_tracks_turn_when_dragged(self):
        page = self.open('scene_paper.scene1_live.html')
        at = page.middle_of('canvas')
        drawn = "document.querySelector('canvas').toDataURL()"
        before = page.ask(drawn)
        self.assertGreater(len(before), 2000)
        page.mouse('mousePressed', at, button='left', clickCount=1)
        page.mouse('mouseMoved', [at[0] + 60, at[1] + 20], button='left')
        page.mouse('mouseReleased', [at[0] + 60, at[1] + 20], button='left', clickCount=1)
        turned = page.ask(drawn)
        self.assertNotEqual(turned, before)
        page.mouse('mouseMoved', [at[0] + 120, at[1]])
        self.assertEqual(page.ask(drawn), turned)
        page.mouse('mouseWheel', at, deltaX=0, deltaY=-300)
        self.assertNotEqual(page.ask(drawn), turned)

    def test_a_broken_limit_leads_to_its_scene_and_back(self):
        page = self.open('index.html')
        page.click('.verdict li a')
        page._await(lambda message: message.get('method') == 'Page.loadEventFired')
        self.assertIn('paper/scene1', page.ask("document.querySelector('h2').textContent"))
        self.assertIn('rerun paper.scene1/live', page.ask('document.body.textContent'))

    def test_light_and_dark_are_both_readable(self):
        for dark in (False, True):
            page = self.open('index.html', dark=dark)
            for selector in ('body', '.verdict', '.fail', 'td', 'th', '.soft'):
                self.assertGreaterEqual(self.contrast(selector), 4.5, f'{selector}, dark: {dark}')

    def contrast(self, selector):
        """WCAG's ratio of the text to the nearest page behind it that is not transparent."""
        return self.browser.ask('''(selector => {
          const parse = text => text.match(/[\\d.]+/g).map(Number);
          const light = rgb => {
            const [r, g, b] = rgb.map(v => v / 255).map(
                v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
            return 0.2126 * r + 0.7152 * g + 0.0722 * b;
          };
          let element = document.querySelector(selector);
          const ink = light(parse(getComputedStyle(element).color).slice(0, 3));
          let page = [0, 0, 0, 0];
          for (; element && page[3] === 0; element = element.parentElement) {
            const found = parse(getComputedStyle(element).backgroundColor);
            page = found.length === 3 ? [...found, 1] : found;
          }
          const paper = light(page.slice(0, 3));
          return (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
        })(''' + repr(selector) + ')')

    def test_nothing_is_wider_than_the_window(self):
        for width in (400, 1280, 1920):
            for name in ('index.html', 'scene_paper.scene1_live.html'):
                page = self.open(name, width=width)
                self.assertLessEqual(page.ask('document.documentElement.scrollWidth'), width, name)

    def whole_without_scripts(self, page):
        self.assertIn('limits broken', page.ask("document.querySelector('.verdict').textContent"))
        self.assertEqual(page.ask("document.querySelectorAll('.sortable, canvas').length"), 0)
        # The style sheet is in force, and charts have their size and colours.
        self.assertNotEqual(page.ask("getComputedStyle(document.body).maxWidth"), 'none')
        self.assertGreater(len(page.picture()), 20000)

    def test_with_scripts_off_the_page_is_whole(self):
        self.whole_without_scripts(self.open('index.html', scripts=False))
        page = self.open('scene_paper.scene1_live.html', scripts=False)
        self.assertGreater(page.ask("document.querySelector('svg').getBoundingClientRect().height"),
                           200)
        self.assertTrue(page.ask("document.querySelector('figure[data-tracks]').hidden"))

    def test_under_the_strict_policy_the_page_is_whole(self):
        for name in ('index.html', 'scene_paper.scene1_live.html'):
            page = self.open(name, policy='strict')
            page.ask('0')  # all that was said of the page is read
            self.assertTrue(all('report.js' in text for text in page.log), page.log)
        self.whole_without_scripts(self.open('index.html', policy='strict'))


if __name__ == '__main__':
    if not CHROMIUM:
        print('no chromium: the report was not looked at (apt-get install chromium)')
        sys.exit(77)
    WRITE_NIGHT = sys.argv.pop(1)
    unittest.main()
