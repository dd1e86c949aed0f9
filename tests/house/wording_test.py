"""The guard of the wording catches what it is there to catch."""

import unittest

import wording


def remedies(source):
    return [remedy for _, _, remedy in wording.complaints(source)]


class WordingTest(unittest.TestCase):
    def test_phrases_that_nobody_would_write_are_refused(self):
        for text in ("x is no MCAP file", "systems of others", "there is nobody 'bea'"):
            self.assertEqual(len(remedies(f'throw InputError("{text}");')), 1, text)

    def test_plain_english_passes(self):
        for text in ("not an MCAP file", "external systems", "no person named 'bea'", "there is no floor"):
            self.assertEqual(remedies(f'throw InputError("{text}");'), [], text)

    def test_literals_are_read_as_the_compiler_joins_them(self):
        self.assertEqual(wording.complaints('\nSay("a file is "  // and on\n    "no file");')[0][:2],
                         (2, "a file is no file"))
        self.assertEqual(remedies('Say("it is ", "no file");'), [])

    def test_raw_literals_are_read(self):
        self.assertEqual(len(remedies('Say(R"x(it is no file (here))x");')), 1)

    def test_comments_and_quotes_are_no_texts(self):
        self.assertEqual(remedies("// this is no text\n/* is no text */ char c = '\"'; // is no text\""), [])
        self.assertEqual(len(remedies('Say("a \\" is no quote");')), 1)


if __name__ == "__main__":
    unittest.main()
