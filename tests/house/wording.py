"""The wording of what users read: no sentence of the kinds that a native engineer would not write.

Usage: wording.py SOURCE_DIR. Looks at all string literals, whole as the compiler joins them, and prints each that
has such a phrase with file, line and what to write instead (exit 1). Comments are not looked at.
"""

import pathlib
import re
import sys

HOUSES = ("harness", "simulator", "slam")
PHRASES = {
    r"(?<!there )\bis no [A-Za-z]": "'not a X' or 'unknown X'",
    r"\bof others\b": "'external' or 'other'",
    r"\b(?:there is )?nobody '": "'no person named X'",
}
TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\((?P<raw>.*?)\)\1"|"(?P<plain>(?:\\.|[^"\\\n])*)"'
    r"|'(?:\\.|[^'\\\n])+'|\s+|.", re.DOTALL)


def literals(source):
    """(line, text) of each literal; literals with nothing but blanks and comments between them are one."""
    found, text, start = [], None, 0
    for token in TOKEN.finditer(source):
        part = token["plain"] if token["plain"] is not None else token["raw"]
        if part is not None:
            if text is None:
                text, start = "", token.start()
            text += part
        elif text is not None and not (token[0].isspace() or token[0].startswith(("//", "/*"))):
            found.append((source.count("\n", 0, start) + 1, text))
            text = None
    return found


def complaints(source):
    """(line, text, remedy) of each literal that has one of the phrases."""
    return [(line, text, remedy) for line, text in literals(source)
            for phrase, remedy in PHRASES.items() if re.search(phrase, text)]


def main(folder):
    wrong = 0
    for house in HOUSES:
        for file in sorted((folder / house).rglob("*")):
            if file.suffix not in (".cc", ".h"):
                continue
            for line, text, remedy in complaints(file.read_text()):
                print(f'{file.relative_to(folder)}:{line}: "{text}": write {remedy}')
                wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
