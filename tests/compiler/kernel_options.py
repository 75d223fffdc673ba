"""What a kernel's source says about its compilation."""

import re


def options_of(source):
    """The options of epiline-hls in a source's line `// epiline-hls: ...`, the last one if there are several."""
    found = re.findall(r"(?m)^// epiline-hls: (.*)", source.read_text(encoding="utf-8"))
    return found[-1].split() if found else []
