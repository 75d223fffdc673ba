"""Files that are there in full or not at all; shared by the scripts of this folder."""

import os


def write_whole(path, text):
    """Writes `text` under another name first; `path` (pathlib.Path) keeps its old contents until that is complete."""
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)


def holds(path, text):
    """Whether `path` is a file with just this text: what was made from other files is not older than they are."""
    return path.is_file() and path.read_text(encoding="utf-8") == text
