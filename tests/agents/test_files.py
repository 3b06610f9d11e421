"""Files are replaced whole, never through links, and what is no plain file is refused at once."""

import os
import socket
import subprocess
import sys
import textwrap
import threading

import pytest

from physexp.agents import files


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_a_link_is_replaced_and_what_it_points_to_stays(tmp_path):
    target, link = tmp_path / "target", tmp_path / "link"
    target.write_bytes(b"precious")
    link.symlink_to(target)
    files.write_atomically(link, b"new")
    assert target.read_bytes() == b"precious"
    assert link.read_bytes() == b"new" and not link.is_symlink()


def test_threads_that_write_the_same_file_each_write_all_of_it(tmp_path):
    contents = [bytes([number]) * 300_000 for number in range(4)]
    errors = []

    def write(content):
        try:
            for _ in range(10):
                files.write_atomically(tmp_path / "file", content)
        except OSError as error:
            errors.append(error)

    threads = [threading.Thread(target=write, args=(content,)) for content in contents]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not errors
    assert (tmp_path / "file").read_bytes() in contents
    assert names(tmp_path) == ["file"]


def test_a_folder_where_the_file_goes_is_named_and_nothing_stays(tmp_path):
    (tmp_path / "file").mkdir()
    with pytest.raises(OSError, match="file'$"):
        files.write_atomically(tmp_path / "file", b"new")
    assert names(tmp_path) == ["file"]


STOPPED_WRITER = """
    import os, pathlib, signal, sys
    from physexp.agents import files

    os.replace = lambda *_, **__: (print("written", flush=True), signal.pause())
    files.write_atomically(pathlib.Path(sys.argv[1]), b"half way")
"""


def test_a_file_may_have_the_longest_name_that_there_is(tmp_path):
    name = "\N{GREEK SMALL LETTER MU}" * 127  # 254 bytes of the 255 that file systems allow.
    files.write_atomically(tmp_path / name, b"1")
    assert names(tmp_path) == [name]


def test_what_a_killed_writer_leaves_is_removed_by_the_next_and_that_of_a_living_one_is_not(tmp_path):
    script = textwrap.dedent(STOPPED_WRITER)
    with subprocess.Popen([sys.executable, "-c", script, tmp_path / "one"], stdout=subprocess.PIPE) as writer:
        try:
            assert writer.stdout.readline() == b"written\n"
            (litter,) = names(tmp_path)
            (tmp_path / ".mine.tmp").touch()  # Of another program.
            files.write_atomically(tmp_path / "two", b"")
            assert names(tmp_path) == sorted([litter, ".mine.tmp", "two"])
        finally:
            writer.kill()
    files.write_atomically(tmp_path / "two", b"")
    assert names(tmp_path) == [".mine.tmp", "two"]


def _link(path):
    (path.parent / "target").write_bytes(b"precious")
    path.symlink_to(path.parent / "target")


def _socket(path):
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(path))


KINDS = {
    "a symbolic link": _link,
    "a pipe": os.mkfifo,
    "a folder": lambda path: path.mkdir(),
    "a socket": _socket,
}


@pytest.mark.parametrize("mode", ["rb", "r", "ab", "w", "r+b"])
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_no_plain_file_is_refused_in_one_line_without_waiting(kind, mode, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # A socket's path is short.
    path = tmp_path / "file"
    KINDS[kind](path.relative_to(tmp_path) if kind == "a socket" else path)
    with pytest.raises(ValueError, match=f"file is {kind}; put a regular file in its place$"):
        files.open_plain(path, mode)
    if kind == "a symbolic link":
        assert (tmp_path / "target").read_bytes() == b"precious"


def test_devices_are_refused():
    with pytest.raises(ValueError, match="/dev/zero is a device; put a regular file in its place$"):
        files.read_plain("/dev/zero", 10)


def test_plain_files_are_opened_as_ever(tmp_path):
    with files.open_plain(tmp_path / "file", "w") as file:
        file.write("one\n")
    with files.open_plain(tmp_path / "file", "a") as file:
        file.write("two\n")
    with files.open_plain(tmp_path / "file", "r") as file:
        assert file.readlines() == ["one\n", "two\n"]
    assert files.read_plain(tmp_path / "file", 8) == b"one\ntwo\n"
    with pytest.raises(FileNotFoundError, match="nothing"):
        files.open_plain(tmp_path / "nothing")


def test_a_file_larger_than_any_of_its_kind_is_not_read(tmp_path):
    with open(tmp_path / "file", "wb") as file:
        file.truncate(2**40)  # It takes no space on the disk.
    with pytest.raises(ValueError, match="file is larger than 1 MB"):
        files.read_plain(tmp_path / "file", 1_000_000)


def test_a_folder_that_is_a_link_is_refused(tmp_path):
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "folder").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(ValueError, match="folder is a symbolic link; put the folder itself in its place$"):
        files.refuse_link(tmp_path / "folder")
    files.refuse_link(tmp_path / "elsewhere")
    files.refuse_link(tmp_path / "nothing")
