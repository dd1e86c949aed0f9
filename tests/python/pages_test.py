"""The blocks of the page about Python run, one after the other, as they are written."""

import re


def test_the_page_runs(source, monkeypatch, tmp_path, capsys):
    page = (source / "reports/docs/python.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```$", page, re.M | re.S)
    assert len(blocks) >= 5
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, "python.md", "exec"), names)
    said = capsys.readouterr().out
    assert "(480, 752) uint8" in said and "lost" not in said
