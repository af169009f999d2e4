#!/usr/bin/env python3
"""What pages tell their readers to type, as files.

  pages.py FOLDER BIN PAGE.md...   makes of each page FOLDER/NAME, NAME being the page's folder or "swage" at the top:
                                   each block of C++ as the file that its first line names, and commands.sh, the lines
                                   of sh that begin with `swage` or run one of those programs, with BIN on the path.

A program's last argument is the mesh that it writes: `swage info` reads it afterwards.
"""

import pathlib
import re
import shlex
import sys

TOP = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def fail(page, what):
    raise SystemExit(f"{page}: {what}")


def programs_of(page, blocks):
    programs = {}
    for text in (text for language, text in blocks if language == "cpp"):
        name = re.match(r"// (\w+)\.cpp\b", text)
        if not name:
            fail(page, f"a block of C++ does not begin with the name of its file, as '// name.cpp': {text[:60]!r}")
        if name[1] in programs:
            fail(page, f"{name[1]}.cpp is there twice")
        programs[name[1]] = text
    return programs


def commands_of(page, blocks, programs):
    lines = [line for language, text in blocks if language == "sh" for line in text.splitlines()]
    commands, unused = [], set(programs)
    for line in lines:
        words = shlex.split(line, comments=True)
        if words[:1] == ["swage"]:
            commands.append(line)
        elif words and words[0].removeprefix("./") in programs:
            unused.discard(words[0].removeprefix("./"))
            commands += [line, f"swage info {shlex.quote(words[-1])}"]
    if unused:
        fail(page, f"no command runs {', '.join(sorted(unused))}")
    if not commands:
        fail(page, "has no commands")
    return commands


def main(folder, bin_folder, *pages):
    for page in map(pathlib.Path, pages):
        blocks = BLOCK.findall(page.read_text(encoding="utf-8"))
        programs = programs_of(page, blocks)
        commands = commands_of(page, blocks, programs)
        place = folder / ("swage" if page.resolve().parent == TOP else page.parent.name)
        place.mkdir(parents=True)
        for name, text in programs.items():
            (place / f"{name}.cpp").write_text(text, encoding="utf-8")
        path = f"PATH={shlex.quote(str(bin_folder))}:$PATH"
        (place / "commands.sh").write_text("\n".join([path, *commands]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), *sys.argv[3:])
