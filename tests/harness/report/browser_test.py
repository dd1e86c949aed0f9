#!/usr/bin/env python3
"""A report as people meet it: clicked through in headless Chromium, light and dark, with scripts,
without, and under the policy that Jenkins puts on artifacts. Skips where Chromium is absent.

usage: browser_test.py WRITE_NIGHT
"""
import functools
import http.server
import math
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


# What is left of linear red, green and blue (Machado, Oliveira and Fernandes, 2009).
DEUTERANOPIA = ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413),
                (-0.011820, 0.042940, 0.968881))
ALL_COLOURS = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
PROTANOPIA = ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216),
              (-0.003882, -0.048116, 1.051998))


def simulated(color, matrix):
    """Linear red, green and blue of "#rrggbb" as the colour-blind see it."""
    parts = [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in parts]
    return [min(1, max(0, sum(m * v for m, v in zip(row, linear)))) for row in matrix]


def lab(linear):
    r, g, b = linear
    xyz = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505, 0.2126 * r + 0.7152 * g + 0.0722 * b, (
        0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089
    x, y, z = [v ** (1 / 3) if v > 0.008856 else 7.787 * v + 16 / 116 for v in xyz]
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def distance(one, other):
    """CIEDE2000 (Sharma, Wu and Dalal, 2005): CIE76 calls two dark blues far apart."""
    (l1, a1, b1), (l2, a2, b2) = one, other
    mean = (math.hypot(a1, b1) + math.hypot(a2, b2)) / 2
    stretch = 1.5 - 0.5 * math.sqrt(mean ** 7 / (mean ** 7 + 25 ** 7))
    a1, a2 = a1 * stretch, a2 * stretch
    c1, c2 = math.hypot(a1, b1), math.hypot(a2, b2)
    h1, h2 = (math.degrees(math.atan2(b, a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    turn = (h2 - h1 + 180) % 360 - 180
    hue = 2 * math.sqrt(c1 * c2) * math.sin(math.radians(turn) / 2)
    light, chroma, middle = (l1 + l2) / 2, (c1 + c2) / 2, (h1 + turn / 2) % 360

    def wave(times, shift):
        return math.cos(math.radians(times * middle - shift))

    weight = (1 - 0.17 * wave(1, 30) + 0.24 * wave(2, 0) + 0.32 * wave(3, -6) - 0.2 * wave(4, 63))
    s_l = 1 + 0.015 * (light - 50) ** 2 / math.sqrt(20 + (light - 50) ** 2)
    s_c, s_h = 1 + 0.045 * chroma, 1 + 0.015 * chroma * weight
    blue = math.radians(60 * math.exp(-((middle - 275) / 25) ** 2))
    both = -2 * math.sqrt(chroma ** 7 / (chroma ** 7 + 25 ** 7)) * math.sin(blue)
    d_l, d_c, d_h = (l2 - l1) / s_l, (c2 - c1) / s_c, hue / s_h
    return math.sqrt(d_l ** 2 + d_c ** 2 + d_h ** 2 + both * d_c * d_h)


def contrast(one, other):
    """Of WCAG, from linear red, green and blue."""
    low, high = sorted(0.2126 * r + 0.7152 * g + 0.0722 * b for r, g, b in (one, other))
    return (high + 0.05) / (low + 0.05)


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


class ServedReport(unittest.TestCase):
    """What `write` makes in `folder`, served to a browser."""
    write = []  # program and what follows the folder

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix='aisle_report_')
        subprocess.run([cls.write[0], cls.folder, *cls.write[1:]], check=True)
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


class ReportInBrowser(ServedReport):
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

    def test_lengths_are_sorted_as_lengths_whatever_their_unit(self):
        rows = [('≈3', '<td data-value="1.2">1.20 m'), ('20', '<td data-value="0.0042">4.2 mm'),
                ('100', '<td data-value="0.0008">0.8 mm'), ('-', '<td>never drives')]
        with open(os.path.join(self.folder, 'sorted.html'), 'w', encoding='utf-8') as file:
            file.write('<!doctype html><meta charset="utf-8"><script src="report.js" defer>'
                       '</script><table><tr><th>step<th>end\n' +
                       '\n'.join(f'<tr><td>{step}{end}' for step, end in rows) + '</table>')
        page = self.open('sorted.html')
        page.click('table th:nth-child(2)')
        self.assertEqual([cell.strip() for cell in self.column('table', 1)],
                         ['0.8 mm', '4.2 mm', '1.20 m', 'never drives'])
        page.click('table th:nth-child(1)')
        self.assertEqual([cell.strip() for cell in self.column('table', 0)],
                         ['≈3', '20', '100', '-'])

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
        self.assertRegex(said, r'error of the live track \[cm\]: orbslam2, median [\d.]+, '
                               r'orbslam2, worst: seed \d [\d.]+, oracle, median [\d.]+')
        self.assertRegex(said, r'pixels that move \[%\]: [\d.]+')
        self.assertRegex(said, r'all [\d.]+, parallax [\d.]+, blur [\d.]+')

    def test_the_slider_shows_another_frame_and_where_it_is(self):
        page = self.open('scene_paper.scene1_live.html')
        picture = "document.querySelector('.viewer img').src"
        said = "document.querySelector('.viewer output').textContent"
        place = "document.querySelector('svg.map .here').getAttribute('cx')"
        first = [page.ask(what) for what in (picture, said, place)]
        self.assertRegex(first[1], r'frame \d+, [\d.]+ s: off by [\d.]+ cm')
        self.assertTrue(page.ask("document.querySelector('.albums').hidden"))
        page.click('.viewer input[type=range]')
        page.key('Home')
        then = [page.ask(what) for what in (picture, said, place)]
        for before, after in zip(first, then):
            self.assertNotEqual(before, after)
        self.assertEqual(page.ask("document.querySelectorAll('.viewer button').length"), 2)
        page.click('.viewer button:nth-child(2)')
        self.assertNotEqual(page.ask(picture), then[0])
        self.assertEqual(page.log, [])

    def test_a_broken_limit_leads_to_its_scene_and_back(self):
        page = self.open('index.html')
        page.follow('.verdict li a')
        self.assertIn('paper/scene1', page.ask("document.querySelector('h2').textContent"))
        self.assertIn('rerun paper.scene1/live', page.ask('document.body.textContent'))

    def test_light_and_dark_are_both_readable(self):
        for dark in (False, True):
            page = self.open('index.html', dark=dark)
            for selector in ('body', '.verdict', '.fail', 'td', 'th', '.soft', 'main a'):
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

    def test_nothing_is_wider_than_the_window_nor_too_small_to_read(self):
        smallest = """Math.min(...[...document.querySelectorAll('svg text')].filter(
            text => text.getClientRects().length > 0).map(
            text => parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a))"""
        for width in (400, 820, 1400, 2560):
            for name in ('index.html', 'scene_paper.scene1_live.html'):
                page = self.open(name, width=width)
                self.assertLessEqual(page.ask('document.documentElement.scrollWidth'), width, name)
            self.assertGreaterEqual(page.ask(smallest), 10.99, width)

    def test_a_wide_window_is_used_and_a_narrow_one_laid_out_anew(self):
        drawn = "document.querySelector('svg.chart').getBoundingClientRect()"
        columns = """new Set([...document.querySelectorAll('.charts figure')].map(
            figure => Math.round(figure.getBoundingClientRect().left))).size"""
        heights = []
        for width, least in ((400, 1), (1400, 2), (2560, 3)):
            page = self.open('scene_paper.scene1_live.html', width=width)
            heights.append(page.ask(drawn + '.height'))
            self.assertGreaterEqual(page.ask(columns), least)
            self.assertGreater(page.ask("document.querySelector('.charts')"
                                        '.getBoundingClientRect().width'), 0.8 * width - 240)
        self.assertEqual(len(set(heights)), 1)  # as high on a phone: not a smaller picture of it

    def test_the_distance_of_colours_is_that_of_its_authors(self):
        for one, other, apart in (((50, 2.6772, -79.7751), (50, 0, -82.7485), 2.0425),
                                  ((50, 2.5, 0), (73, 25, -18), 27.1492),
                                  ((22.7233, 20.0904, -46.6940), (23.0331, 14.9730, -42.5619), 2.0373),
                                  ((90.8027, -2.0831, 1.4410), (91.1528, -1.6435, 0.0447), 1.4441)):
            self.assertAlmostEqual(distance(one, other), apart, delta=1e-4)

    def test_systems_are_apart_for_the_colour_blind_and_all_others(self):
        for dark in (False, True):
            page = self.open('index.html', dark=dark)
            names = [f'--c{style}' for style in range(12)]
            colors = [page.ask(f"getComputedStyle(document.documentElement)"
                               f".getPropertyValue('{name}').trim()") for name in names]
            for matrix in (ALL_COLOURS, DEUTERANOPIA, PROTANOPIA):
                seen = [lab(simulated(color, matrix)) for color in colors]
                for i, one in enumerate(seen):
                    for other in range(i):
                        self.assertGreater(distance(one, seen[other]), 21 if i < 6 else 10.5,
                                           (dark, names[i], names[other]))
            card = page.ask("getComputedStyle(document.documentElement).getPropertyValue('--card')"
                            ".trim()")
            for name, color in zip(names, colors):
                self.assertGreaterEqual(contrast(simulated(color, ALL_COLOURS),
                                                 simulated(card, ALL_COLOURS)), 2.99, name)
            page.ask('document.body.innerHTML = \'<svg class="chart">\' + [...Array(12).keys()].map('
                     'i => `<line class="line c${i}"/>`).join("") + "</svg>"')
            dashes = page.ask("[...document.querySelectorAll('line')].map("
                              "line => getComputedStyle(line).strokeDasharray)")
            self.assertGreaterEqual(len(set(dashes)), 11)

    def test_on_paper_the_stills_stand_and_nothing_is_to_be_clicked(self):
        page = self.open('scene_paper.scene1_live.html', media='print')
        self.assertEqual(page.ask("getComputedStyle(document.querySelector('.viewer')).display"),
                         'none')
        self.assertGreater(page.ask("document.querySelector('.albums').getBoundingClientRect()"
                                    '.height'), 50)
        self.assertEqual(page.ask("getComputedStyle(document.querySelector('.contents')).display"),
                         'none')
        self.assertEqual(page.ask('getComputedStyle(document.body).backgroundColor'),
                         'rgb(255, 255, 255)')

    def test_the_contents_lead_to_every_part(self):
        page = self.open('index.html')
        targets = page.ask("[...document.querySelectorAll('.contents a')].map("
                           "a => document.getElementById(a.hash.slice(1)) !== null)")
        self.assertGreaterEqual(len(targets), 3)
        self.assertTrue(all(targets))

    def whole_without_scripts(self, page):
        self.assertIn('verdicts failed', page.ask("document.querySelector('.verdict').textContent"))
        self.assertEqual(page.ask("document.querySelectorAll('.sortable, .viewer').length"), 0)
        # The style sheet is in force, and charts have their size and colours.
        self.assertNotEqual(page.ask("getComputedStyle(document.body).paddingLeft"), '8px')
        self.assertGreater(len(page.picture()), 20000)

    def test_with_scripts_off_the_page_is_whole(self):
        self.whole_without_scripts(self.open('index.html', scripts=False))
        page = self.open('scene_paper.scene1_live.html', scripts=False)
        self.assertGreater(page.ask("document.querySelector('svg').getBoundingClientRect().height"),
                           200)
        self.assertGreater(page.ask("document.querySelectorAll('.album img').length"), 3)

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
    ReportInBrowser.write = [sys.argv.pop(1), '3', '3']
    unittest.main()
