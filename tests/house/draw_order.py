"""No two draws of one random stream stand where C++ leaves their order open.

Usage: draw_order.py SOURCE_DIR. The arguments of a call and the sides of most operators are
evaluated in the order that a compiler likes, GCC the last argument first, Clang the first first: a
stream that two of them draw from gives other numbers with another compiler. Lists in braces are in
order, and so are the sides of &&, ||, ?:, << and =.
"""

import pathlib
import re
import sys

HOUSES = ("simulator", "harness", "slam")
STREAMS = r"(?:Dice|CrowdRandom|PathRandom|Draws|CounterRandom)"
DECLARED = re.compile(rf"\b{STREAMS}\s*([*&]?)\s*\b(\w+)\s*[;,(){{=]")
# Comments, texts and characters, all of which are blanked.
BLANK = re.compile(
    r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])'", re.DOTALL)
TOKEN = re.compile(r"[A-Za-z_]\w*|::|->|&&|\|\||<<|[=!<>]=|[^\s\w]|\d[\w.']*|\n")
CLOSES = {"(": ")", "[": "]", "{": "}"}
IN_ORDER = {"&&", "||", "?", ":", "<<", "=", ";"}
CONTROL = {"if", "while", "switch", "for"}


def streams_of(text):
    """The names of streams, each with whether it is a pointer to one."""
    return {name: mark == "*" for mark, name in DECLARED.findall(text)}


def tree_of(text):
    """Nested lists of (line, token); a list's first token is its bracket."""
    blank = BLANK.sub(lambda m: "\n" * m.group().count("\n"), text)
    line, stack = 1, [[(0, "{")]]
    for token in TOKEN.findall(blank):
        if token == "\n":
            line += 1
        elif token in CLOSES:
            stack.append([(line, token)])
        elif token in CLOSES.values():
            if len(stack) > 1:
                group = stack.pop()
                stack[-1].append(group)
        else:
            stack[-1].append((line, token))
    while len(stack) > 1:
        group = stack.pop()
        stack[-1].append(group)
    return stack[0]


def is_lambda(items, i):
    """Whether the braces at i are a body and not a list: it runs when it is called."""
    before = items[i - 1] if i else None
    if isinstance(before, list):
        return before[0][1] in "(["  # also of a function, an if or a for
    return before is None or before[1] in {"const", "mutable", "noexcept", "else", "do"}


def draws(items, streams, found):
    """The streams drawn from in an expression, each once a draw; what is open goes to `found`."""
    drawn = []
    skip = None
    for i, item in enumerate(items):
        if isinstance(item, list):
            kind = item[0][1]
            within = parts(item, streams, found)
            if kind == "{" and is_lambda(items, i):
                continue
            if i == skip:  # the arguments of a draw: they come before it
                within = [w for w in within if w != drawn[-1][1]]
            drawn += [(item[0][0], name) for name in within]
        elif item[1] in streams and not declares(items, i):
            drawn.append((item[0], item[1]))
            skip = i + 3
    seen = {}
    for line, name in drawn:
        if name in seen:
            found.add((line, name))
        seen[name] = line
    return set(seen)


def declares(items, i):
    """Whether the name at i is a declaration's or another thing's member."""
    before = items[i - 1] if i else None
    if isinstance(before, list) or before is None:
        return False
    if re.fullmatch(STREAMS, before[1]) or before[1] in {".", "->", "::"}:
        return True
    return (before[1] in "*&" and i > 1 and not isinstance(items[i - 2], list)
            and re.fullmatch(STREAMS, items[i - 2][1]) is not None)


def handed(piece, streams):
    """The stream that an argument hands on by its address, if it does nothing else."""
    names = [item[1] for item in piece if not isinstance(item, list)]
    if len(names) != len(piece) or not names or names[-1] not in streams:
        return None
    by_address = names[:-1] == ["&"] or (len(names) == 1 and streams[names[0]])
    return names[-1] if by_address else None


def parts(group, streams, found):
    """The streams drawn from in a bracket."""
    kind, items = group[0][1], group[1:]
    arguments, piece, among, handed_on = [], [], [], set()

    def end():
        if kind == "(" and (name := handed(piece, streams)):
            handed_on.add(name)  # drawn from when all arguments are there
        else:
            among.append(draws(piece, streams, found))
        piece.clear()

    for i, item in enumerate(items):
        token = item[1] if not isinstance(item, list) else None
        ends = token in IN_ORDER or token == ","
        control = (isinstance(item, list) and item[0][1] == "(" and i
                   and not isinstance(items[i - 1], list) and items[i - 1][1] in CONTROL)
        body = isinstance(item, list) and item[0][1] == "{" and kind == "{"
        if not ends:
            piece.append(item)
        if ends or control or body:
            end()
        if token == ",":
            arguments.append(set().union(*among))
            among.clear()
    end()
    arguments.append(set().union(*among))
    if kind == "(":
        for k, one in enumerate(arguments):
            for name in one & set().union(*arguments[:k]):
                found.add((line_of(items), name))
    return set().union(*arguments, handed_on)


def line_of(items):
    for item in items:
        return item[0][0] if isinstance(item, list) else item[0]
    return 0


def offences(text, header=""):
    """(line, stream) of each place where the order of two draws is open."""
    found = set()
    parts(tree_of(text), streams_of(header) | streams_of(text), found)
    return sorted(found)


def main(source_dir):
    source = pathlib.Path(source_dir)
    bad = files = 0
    for house in HOUSES:
        for path in sorted(source.glob(f"{house}/**/*")):
            if path.suffix not in (".h", ".cc"):
                continue
            files += 1
            beside = path.with_suffix(".h")
            header = beside.read_text() if beside.exists() else ""
            for line, name in offences(path.read_text(), header):
                print(f"{path.relative_to(source)}:{line}: two draws of {name} in no given order")
                bad += 1
    print(f"{files} files, {bad} offences")
    return 1 if bad or not files else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
