"""No two types of one namespace have one name.

Usage: one_definition.py SOURCE_DIR. Two files that define a type of the same full name compile, and
link: of their inline functions, destructors among them, one is kept for both. Types of one file's
anonymous namespace are its own.
"""

import collections
import pathlib
import re
import sys

HOUSES = ("simulator", "harness", "slam", "tests")
# Comments, texts, characters and the preprocessor's lines, all of which are left out.
BLANK = re.compile(
    r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])'"
    r"|^[ \t]*#(?:[^\\\n]|\\.)*", re.DOTALL | re.MULTILINE)
NAMESPACE = re.compile(r"\b(?:inline\s+)?namespace\b\s*([\w:]*)\s*$")
TYPE = re.compile(r"\b(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+(?:alignas\s*\([^)]*\)\s*)?"
                  r"(?:\[\[[^\]]*\]\]\s*)?([\w:]+)\s*(<[^;{}]*>)?\s*(?:final\s*)?(?::[^:;][^;{}]*)?$")


def types_of(text):
    """The full names of the types that a file defines where others can name them."""
    text = BLANK.sub(" ", text)
    found, scopes, begin = [], [], 0
    for mark in re.finditer(r"[{};]", text):
        said, begin = text[begin:mark.start()].strip(), mark.end()
        if mark[0] == "}":
            if scopes:
                scopes.pop()
        elif mark[0] == "{":
            # A scope is the name of its namespace, "" of an anonymous one, None of anything else.
            scope = None
            if named := NAMESPACE.search(said):
                scope = named[1]
            elif (type_ := TYPE.search(said)) and all(scopes):
                found.append("::".join([*scopes, type_[1] + (type_[2] or "")]))
            scopes.append(scope)
    return found


def twice(files):
    """(name, files) of each type with more than one definition, of {file: text}."""
    homes = collections.defaultdict(list)
    for file, text in files.items():
        for name in types_of(text):
            homes[name].append(file)
    return sorted((name, where) for name, where in homes.items() if len(where) > 1)


def main(source_dir):
    source = pathlib.Path(source_dir)
    files = {path.relative_to(source): path.read_text()
             for house in HOUSES for path in sorted(source.glob(f"{house}/**/*")) if path.suffix in (".h", ".cc")}
    found = twice(files)
    for name, where in found:
        print(f"{name} is defined in {', '.join(map(str, where))}: give one another name, or an anonymous namespace")
    print(f"{len(files)} files, {len(found)} names taken twice")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
