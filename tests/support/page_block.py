"""Rewrites a block of a Markdown page, as `aisle ... --into PAGE#BLOCK` does."""

import re


def put(page, name, folders, body, foot):
    """Between the marks of the block stand the body and, beneath, the command that made it with its
    commit; `folders` are those on whose code the figures hang. A page without such a block gets it
    at its end."""
    block = f"<!-- begin {name}: {folders} -->\n\n{body}\n\n{foot}\n<!-- end {name} -->"
    there = re.compile(rf"^<!-- begin {name}: [^>]*? -->\n.*?^<!-- end {name} -->$",
                       re.MULTILINE | re.DOTALL)
    text = page.read_text() if page.exists() else ""
    new, count = there.subn(lambda _: block, text)
    aside = page.with_name(page.name + ".part")
    aside.write_text(new if count else text.rstrip("\n") + "\n\n" + block + "\n")
    aside.replace(page)
