"""The reference pages of reports/docs, from what reader, program and schema say of themselves.

Usage: reference.py PROGRAM SOURCE_DIR [--write]. scene.md comes from scenes/scene.schema.json,
commands.md from --help of every command, options.md from `aisle systems NAME --json`, scores.md from
`aisle scores --json`, by way of reports/docs/scores.head.md, which explains them. Without --write it
says which page is behind (exit 1). `cmake --build build/release --target reference` writes these
pages, suite.md and the two schemas.
"""

import json
import pathlib
import re
import subprocess
import sys

HEAD = "<!-- Written by tests/docs/reference.py; what stands here is changed at its source. -->\n\n"


def ask(program, *words):
    run = subprocess.run([program, *words], capture_output=True, text=True)
    if run.returncode:
        sys.exit(f"{program} {' '.join(words)}: exit {run.returncode}: {run.stderr}")
    return run.stdout


def cell(text):
    return str(text).replace("|", "\\|").replace("<", "&lt;").replace("\n", " ")


def table(names, rows):
    lines = ["| " + " | ".join(names) + " |", "|" + "---|" * len(names)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


# --- scene.md ---------------------------------------------------------------------------------------


def allowed(node):
    if "enum" in node:
        return ", ".join(str(word) for word in node["enum"])
    low, high = node.get("minimum"), node.get("maximum")
    bounds = f", {low:g} to {high:g}" if low is not None and high is not None else ""
    kind = node.get("type", "")
    if kind == "array":
        items = node.get("items", {})
        if node.get("maxItems") == node.get("minItems") and node.get("minItems"):
            return f"{node['minItems']} of: {allowed(items)}"
        return "a list of maps" if items.get("type") == "object" else f"a list of: {allowed(items)}"
    names = {"object": "a map", "string": "a text", "integer": "an integer", "number": "a number"}
    return names.get(kind, "true or false" if kind == "boolean" else "") + bounds


def scene_rows(node, path=""):
    required = set(node.get("required", []))
    for name, child in node.get("properties", {}).items():
        meaning, _, example = child.get("description", "").partition("; e.g. ")
        default = "(required)" if name in required else str(child.get("default", ""))
        yield [f"`{path}{name}`", cell(meaning), cell(allowed(child)), cell(default), f"`{cell(example)}`" if example else ""]
        yield from scene_rows(child, f"{path}{name}.")
        if isinstance(child.get("items"), dict):
            yield from scene_rows(child["items"], f"{path}{name}[].")


def scene_page(source):
    schema = json.loads((source / "scenes/scene.schema.json").read_text())
    rows = list(scene_rows(schema))
    return (
        f"# Scene files\n\nEvery key of a scene, {len(rows)} of them, as the reader describes it. Lengths are in\n"
        "metres, angles in degrees counter-clockwise from x, times in seconds from the first frame. `aisle\n"
        "check FILE` names every mistake with its place; an editor that reads the schema line at a scene's\n"
        "top completes and checks while one types.\n\n"
        + table(["key", "meaning", "allowed values", "default", "example"], rows)
    )


# --- commands.md --------------------------------------------------------------------------------------


def subcommands(help_text):
    part = re.search(r"^Subcommands:\n(.*?)\n(?:\n|\Z)", help_text + "\n", re.M | re.S)
    return re.findall(r"^  ([a-z][a-z-]*)", part.group(1), re.M) if part else []


def command_sections(program, words=()):
    text = ask(program, *words, "--help")
    yield "#" * (len(words) + 1) + " " + " ".join(["aisle", *words]), text
    for name in subcommands(text):
        yield from command_sections(program, (*words, name))


def commands_page(program):
    sections = [
        f"{heading}\n\n```text\n{text.rstrip()}\n```\n" for heading, text in command_sections(program)
    ]
    sections[0] = sections[0].replace("# aisle\n", "# Commands\n\nWhat `--help` says of each; `man aisle-run` where aisle is installed.\n", 1)
    return "\n".join(sections)


# --- options.md ---------------------------------------------------------------------------------------


def option_allowed(option):
    if option["kind"] in ("number", "integer"):
        return f"{option['low']:g} to {option['high']:g}"
    return "true or false" if option["kind"] == "flag" else ", ".join(option.get("choices", ["a text"]))


def options_page(program):
    systems = json.loads(ask(program, "systems", "--json"))["systems"]
    text = (
        "# Options of the systems\n\nEvery option of every system, with its default there. A suite sets them by "
        "`options:` of a\nvariant, a trial by `--set SYSTEM.PATH=VALUE`. One that has no effect with a system's base "
        "or\nmethod is not listed and refused.\n"
    )
    for system in systems:
        options = json.loads(ask(program, "systems", system["name"], "--json"))["options"]
        rows = [
            [f"`{o['path']}`", cell(o["value"] + (f" {o['unit']}" if o["unit"] else "")), cell(option_allowed(o)), cell(o["help"])]
            for o in options
        ]
        text += f"\n## {system['name']}\n\n{system['description']}.\n\n".replace("..", ".")
        text += table(["option", "default", "allowed values", "meaning"], rows)
    return text


# --- scores.md ----------------------------------------------------------------------------------------


def scores_page(program, source):
    scores = json.loads(ask(program, "scores", "--json"))["scores"]
    rows = [[f"`{s['name']}`", "" if s["unit"] == "1" else cell(s["unit"]), cell(s["help"])] for s in scores]
    explained = (source / "reports/docs/scores.head.md").read_text().rstrip()
    return explained + "\n\n## Every score\n\n" + table(["score", "unit", "what it is"], rows)


def main(program, source_dir, *options):
    source = pathlib.Path(source_dir)
    pages = {
        "scene.md": scene_page(source),
        "commands.md": commands_page(program),
        "options.md": options_page(program),
        "scores.md": scores_page(program, source),
    }
    behind = []
    for name, text in pages.items():
        page = source / "reports/docs" / name
        if page.exists() and page.read_text() == HEAD + text:
            continue
        if "--write" in options:
            page.write_text(HEAD + text)
        else:
            behind.append(name)
    if behind:
        print(f"behind: {', '.join(behind)}; mend with: cmake --build build/release --target reference")
    return 1 if behind else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
