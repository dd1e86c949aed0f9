#!/usr/bin/env python3
"""A forged bad month, read as by somebody who sees the report for the first time: what got worse,
since when, why, and show me, in three clicks each from the last night's page. One scene drifts from
night 12 on, a foreign system crashes from night 20 on, one system is slower from night 25 on. Skips
where Chromium is absent.

usage: month_test.py WRITE_MONTH
"""
import shutil
import sys
import unittest

from browser_test import ServedReport

CHROMIUM = shutil.which('chromium')
LAST = '2026-01-30'


class BadMonth(ServedReport):
    def open(self, page='index.html', **how):
        self.browser.open(f'{self.root}/plain/{LAST}/{page}', **how)
        return self.browser

    def text(self, selector='main'):
        return self.browser.ask(f"document.querySelector('{selector}').textContent")

    def link(self, words, within='main'):
        """Marks the first link whose line holds the words, to be clicked."""
        found = self.browser.ask(
            f"(a => a ? (a.setAttribute('data-test', ''), true) : false)"
            f"([...document.querySelectorAll('{within} a')].find("
            f"a => (a.closest('li, tr') || a).textContent.includes({words!r}) "
            f"&& a.getClientRects().length > 0))")
        self.assertTrue(found, words)
        return '[data-test]'

    def test_what_got_worse_stands_on_the_first_page(self):
        self.open()
        verdict = self.text('.verdict')
        self.assertIn('verdicts failed', verdict)
        self.assertIn('3 of 36 runs failed', verdict)
        self.assertIn('paper/scene2 live robust: ate_rmse_m', verdict)
        self.assertIn('paper.scene3/live/mine/1: completes', verdict)

    def test_since_when_stands_beside_it_and_its_chart_is_a_click_away(self):
        page = self.open()
        line = page.ask("[...document.querySelectorAll('.verdict li')].find(li => li.textContent"
                        ".includes('paper/scene2 live robust')).textContent")
        self.assertIn('since 2026-01-12', line)
        crash = page.ask("[...document.querySelectorAll('.verdict li')].find(li => li.textContent"
                         ".includes('mine/1: completes')).textContent")
        self.assertIn('since 2026-01-20', crash)
        page.follow('.verdict a.since')
        self.assertIn('30 nights', self.text('h1'))
        changes = self.text('.changes')
        self.assertIn('paper/scene2 live robust: ATE RMSE from', changes)
        self.assertIn('since 2026-01-12 (19 nights', changes)
        self.assertIn('paper/scene3 live mine: 3 of 3 seeds fail since 2026-01-20 (11 nights', changes)
        self.assertIn('robust: step from 35 ms to 61 ms since 2026-01-25 (6 nights', changes)
        self.assertIn('./aisle bisect v1.4 v1.5', changes)  # whose versions are known
        self.assertEqual(page.log, [])

    def test_a_point_leads_to_its_night(self):
        page = self.open('trends.html')
        self.assertGreater(page.ask("document.querySelectorAll('svg a').length"), 100)
        href = page.ask("document.querySelector('svg a').getAttribute('href')")
        self.assertRegex(href, r'^\.\./2026-01-01/')
        page.follow('svg a .dot')
        self.assertIn('/2026-01-01/', page.ask('location.href'))

    def test_why_stands_on_the_scene_that_broke(self):
        page = self.open()
        page.follow(self.link('paper/scene2 live robust: ate_rmse_m', '.verdict'))
        answer = self.text('ul.answer')
        self.assertRegex(answer, r'robust is off by [\d.]+ cm in the median of 3 seeds, from [\d.]+ cm '
                                 r'to [\d.]+ cm \(worst: seed 3\)')
        self.assertIn('worst: seed 3', self.text('.charts'))
        self.assertIn('rerun paper.scene2/live/robust/3', self.text())

    def test_why_it_crashed_is_quoted_and_harmless(self):
        page = self.open()
        page.follow(self.link('mine/1: completes', '.verdict'))
        self.assertIn('Assertion `points > 0', self.text('.trouble pre'))
        self.assertIn('signal 6, SIGABRT', self.text('.trouble'))
        self.assertEqual(page.log, [])

    def test_show_me_is_the_worst_frame_at_once_and_the_others_under_a_slider(self):
        page = self.open()
        page.follow(self.link('paper/scene2 live robust: ate_rmse_m', '.verdict'))
        self.assertTrue(page.ask("document.querySelector('.viewer img').src.includes("
                                 "'worst_error')"))
        page.click('.viewer input[type=range]')
        page.key('Home')
        self.assertIn('frame 20', self.text('.viewer output'))

    def test_a_system_looks_the_same_in_every_night_and_on_every_page(self):
        page = self.open()
        style = """[...document.querySelectorAll('.chip')].find(chip =>
            chip.parentNode.textContent.trim().startsWith('mine')).className"""
        first = page.ask(style)
        self.open('scene_paper.scene1_live.html')
        self.assertEqual(page.ask(style), first)
        number = first.split('c')[-1]
        self.open('trends.html')
        self.assertTrue(page.ask(f"[...document.querySelectorAll('p.legend span')].some(one => "
                                 f"one.textContent.includes('mine') && "
                                 f"one.querySelector('.c{number}'))"))

    def test_the_months_pages_are_readable_at_every_width(self):
        for width in (400, 1400, 2560):
            page = self.open('trends.html', width=width)
            self.assertLessEqual(page.ask('document.documentElement.scrollWidth'), width)


if __name__ == '__main__':
    if not CHROMIUM:
        print('no chromium: the month was not looked at (apt-get install chromium)')
        sys.exit(77)
    BadMonth.write = [sys.argv.pop(1)]
    unittest.main()
