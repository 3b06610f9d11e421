"""Text from others reaches terminals and pages as text alone."""

import html
import json
import shutil

import commands

from physexp.analysis.data import text
from physexp.analysis.score import protocol, scoring, targets

HOSTILE = "mine; score 0.9990\x1b[8m\n\r\x9b2K\u202e\udcff"
SHOWN = r"mine; score 0.9990\x1b[8m\n\r\x9b2K\u202e\udcff"


def test_plain_text_is_one_printable_line_with_letters_of_all_languages():
    assert text.plain(HOSTILE) == SHOWN
    assert text.plain("Größe 4 μm, 物理") == "Größe 4 μm, 物理"


def test_markup_in_a_page_is_text():
    for given in ("<script>", "[x](y)", "a | b", "**a** `b` ~c~ _d_", "![i](u)", "<!-- &amp; -->", "$x$", "www.a.b"):
        escaped = text.escaped(given)
        assert not set(escaped) & set("<>[]|*`~_$") and "www." not in escaped and html.unescape(escaped) == given


def test_commands_show_escape_sequences_of_a_file_as_text(tmp_path):
    folder = tmp_path / "score"
    scoring.score(targets.find("silent"), protocol.named(["threshold/features"]), 1, folder)
    written = json.loads((folder / scoring.FILE).read_text())
    (folder / scoring.FILE).write_text(json.dumps({**written, "target": HOSTILE}))
    done = commands.run("verify", folder, check=True)
    assert done.stdout.startswith(f"OK: 1 episodes were played so, by {SHOWN}; score threshold/features -")
    assert len(done.stdout.splitlines()) == 1
    (folder / scoring.FILE).write_text(json.dumps({**written, "version": HOSTILE}))
    moved = shutil.move(folder, tmp_path / "\x1b[8m")
    done = commands.run("verify", moved)
    assert done.returncode == 2 and done.stderr.startswith("physexp: ") and done.stderr.rstrip("\n").isprintable()
