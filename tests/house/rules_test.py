"""What each folder may include: as its text reads, and as the build's include paths hold it to.

Usage: rules_test.py SOURCES COMPILE_COMMANDS
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

SOURCES, COMMANDS = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])

# Beside itself and include/.
SEES = {
    "cpu_ref": [],
    "host/mesh": [],
    "host/solve": [],
    "host/io": ["host/mesh"],
    "host/given": ["host/mesh", "host/solve"],
    "host/reshape": ["host/mesh", "host/solve", "host/given"],
    "host/deform": ["host/mesh", "host/solve", "host/given"],
    "host/stylize": ["host/mesh", "host/solve", "host/given"],
    "host/template": ["host/mesh", "host/solve", "host/given", "host/external"],
    "host/resize": ["host/mesh", "host/solve"],
    "host/compare": ["host/mesh"],
    "host/transfer": ["host/mesh", "host/external"],
    "host/external": ["host/mesh", "host/solve"],
    "host/render": ["host/mesh", "host/io", "host/external"],
    "host/opencl": [],
    "host/cli": ["host/mesh"],
}

# Other libraries, beside the standard one, Eigen and the system's, and the folders that may know of them.
LIBRARIES = {
    r"CL/": ["host/opencl"],
    r"embree|tetgen|CGAL/|cholmod|boost/": ["host/external"],
    r"nlohmann/": ["host/io", "host/template", "host/cli"],
    r"nanoflann": ["cpu_ref"],
    r"LBFGS": ["host/template"],
    r"stb/": ["host/render"],
    r"CLI/|spdlog/": ["host/cli"],
}
OURS = r"Eigen/|unsupported/Eigen/|omp\.h|unistd\.h|fcntl\.h|poll\.h|signal\.h|spawn\.h|stdlib\.h|sys/|[a-z_]+>"

# Public headers of which a shared library has nothing to show.
ALL_INLINE = ["thrown.h"]


def folder_of(path):
    parts = path.relative_to(SOURCES).parts
    return "/".join(parts[:2]) if parts[0] == "host" else parts[0]


def included(text):
    return re.findall(r'^\s*#\s*include\s*([<"][^>"]+[>"])', text, re.MULTILINE)


def breaches(folder, text, own_names=()):
    """What `text`, in a file of `folder`, includes against the rules."""
    found = []
    for name in included(text):
        inner = name[1:]
        library = next((pattern for pattern in LIBRARIES if re.match(pattern, inner)), None)
        if folder == "include":
            good = re.match(r"<(Eigen/\w+|[a-z_]+)>", name) or re.match(r'"swage/\w+\.h"', name)
        elif folder == "kernels":
            good = name.startswith('"') and inner[:-1] in own_names
        elif library is not None:
            good = folder in LIBRARIES[library]
        else:
            good = name.startswith('"') or re.match(OURS, inner)
        if not good:
            found.append(name)
    return found


class Text(unittest.TestCase):
    def test_keeps_to_the_rules(self):
        kernels = {str(path.relative_to(SOURCES / "kernels")) for path in SOURCES.glob("kernels/**/*.*")}
        kernels |= {pathlib.Path(name).name for name in kernels}
        count = 0
        for top in ("include", "host", "cpu_ref", "kernels"):
            for path in sorted(SOURCES.glob(f"{top}/**/*")):
                if path.suffix in (".h", ".cpp", ".cl"):
                    count += 1
                    with self.subTest(path=path.relative_to(SOURCES)):
                        text = path.read_text(encoding="utf-8")
                        folder = folder_of(path).removesuffix("_off")
                        self.assertEqual(breaches(folder, text, kernels), [])
        self.assertGreater(count, 300)

    def test_knows_every_folder(self):
        folders = {f"host/{path.parent.name}" for path in SOURCES.glob("host/*/CMakeLists.txt")}
        self.assertEqual({folder for folder in folders if not folder.endswith("_off")}, SEES.keys() - {"cpu_ref"})

    def test_shows_what_public_headers_declare(self):
        """Else it is hidden in shared libraries."""
        for path in sorted(SOURCES.glob("include/swage/*.h")):
            if path.name in ALL_INLINE:
                continue
            with self.subTest(path=path.name):
                self.assertRegex(
                    path.read_text(encoding="utf-8"),
                    r"(?s)\n#pragma GCC visibility push\(default\)\nnamespace swage \{\n.*\n#pragma GCC visibility pop\n$",
                )

    def test_is_seen_to_break_them(self):
        for folder, line in (
            ("include", "#include <nlohmann/json.hpp>"),
            ("include", '#include "adjacency.h"'),
            ("kernels", "#include <Eigen/Core>"),
            ("host/reshape", "#include <CL/opencl.hpp>"),
            ("host/resize", "#include <embree3/rtcore.h>"),
            ("cpu_ref", "#include <CGAL/Surface_mesh.h>"),
            ("host/mesh", "#include <spdlog/spdlog.h>"),
            ("host/solve", "#include <boost/optional.hpp>"),
        ):
            with self.subTest(folder=folder, line=line):
                self.assertEqual(len(breaches(folder, line)), 1)


def constants(text, where):
    """Constants declared at `where`, a pattern of what stands before them in their line."""
    lines = re.findall(rf"^{where}(?:static )?constexpr (.*)$", text, re.MULTILINE)
    return {name for line in lines for name in re.findall(r"\b(k[A-Z]\w*)(?=\s*[=\[{])", line)}


class LongFiles(unittest.TestCase):
    """The files of a folder compile as one: a function's constant must not hide another file's, which Clang refuses and
    GCC does not tell."""

    def test_hide_no_constant(self):
        folders = {path.parent for top in ("host", "cpu_ref", "tests") for path in SOURCES.glob(f"{top}/**/*.cpp")}
        self.assertGreater(len(folders), 20)
        for folder in sorted(folders):
            texts = {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.cpp")}
            of_files = {name: constants(text, "") for name, text in texts.items()}
            for name, text in texts.items():
                others = set().union(*(of_files[other] for other in texts if other != name))
                with self.subTest(path=folder.relative_to(SOURCES) / name):
                    self.assertEqual(constants(text, r"[ \t]+") & others, set())

    def test_is_seen_to_find_them(self):
        text = "constexpr double kA = 1, kB = 2;\nvoid f() {\n  constexpr int kC[] = {1};\n}\n"
        self.assertEqual(constants(text, ""), {"kA", "kB"})
        self.assertEqual(constants(text, r"[ \t]+"), {"kC"})


class IncludePaths(unittest.TestCase):
    """Each folder's own compile command, over one line that includes another folder's header."""

    @classmethod
    def setUpClass(cls):
        cls.flags = {}
        for entry in json.loads(COMMANDS.read_text(encoding="utf-8")):
            path = pathlib.Path(entry["file"])
            if path.parent.parent.name == "swage_remesh.dir":  # Of helpers, which are programs of their own.
                continue
            if path.parent.name == "Unity":  # One of CMake's, of several sources of a folder.
                path = SOURCES / path.parents[3].relative_to(COMMANDS.parent) / path.name
            if not path.is_relative_to(SOURCES) or "_off" in str(path) or path.parent.name == "helpers":
                continue
            words = shlex.split(entry["command"])
            flags = [w for w in words if re.match(r"-(I|D|std)", w)]
            for at, word in enumerate(words):
                if word == "-isystem":
                    flags += words[at : at + 2]
            cls.flags.setdefault(folder_of(path), set()).add(tuple(flags))
        cls.compiler = next(w for w in words if re.search(r"(\+\+|g\+\+-\d+|clang\+\+-\d+)$", w))

    def compiles(self, folder, flags, header):
        # Beside the folder's own files, as a line of theirs would be.
        return (
            subprocess.run(
                [self.compiler, *flags, f"-I{SOURCES / folder}", "-E", "-x", "c++", "-", "-o", "/dev/null"],
                input=f'#include "{header}"\n',
                text=True,
                capture_output=True,
                check=False,
            ).returncode
            == 0
        )

    def test_hold_each_folder_to_the_rules(self):
        headers = {folder: sorted(SOURCES.glob(f"{folder}/*.h")) for folder in [*SEES, "kernels/shared"]}
        for folder, sees in SEES.items():
            self.assertIn(folder, self.flags)
            names = {path.name for seen in [folder, *sees] for path in headers[seen]}
            for other, files in headers.items():
                if other in [folder, *sees]:
                    continue
                alien = [path.name for path in files if path.name not in names][:1]
                for header in alien:
                    for flags in self.flags[folder]:
                        with self.subTest(folder=folder, header=f"{other}/{header}"):
                            self.assertFalse(self.compiles(folder, flags, header))
            with self.subTest(folder=folder, header="its own and swage/mesh.h"):
                for flags in self.flags[folder]:
                    self.assertTrue(self.compiles(folder, flags, "swage/mesh.h"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
