"""Where memory ends, the program ends with one line that says so, or with its result.

The second argument is the library of many_cores.cpp. With --all: more steps, and a mesh that needs more than 4 GiB."""

import math
import resource
import struct
import sys
import unittest

ALL = "--all" in sys.argv
if ALL:
    sys.argv.remove("--all")

MANY_CORES = sys.argv.pop(2)

from commands import COMMANDS, Ground, arguments_of  # pylint: disable=wrong-import-position

MIB = 1 << 20
# With less the program refuses to begin, or does so soon.
LEAST = 512 * MIB
LIMITS = {"address space": (resource.RLIMIT_AS, 4096 * MIB), "data": (resource.RLIMIT_DATA, 1024 * MIB)}


def write_grid(path, cells):
    """A wavy sheet of 2 cells^2 triangles."""
    side = cells + 1
    point, faces = struct.Struct("<3f"), struct.Struct("<B3iB3i")
    with open(path, "wb") as file:
        head = (
            f"ply\nformat binary_little_endian 1.0\nelement vertex {side * side}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {2 * cells * cells}\nproperty list uchar int vertex_indices\nend_header\n"
        )
        file.write(head.encode())
        for y in range(side):
            wave = math.cos(7 * y / cells) / 9
            row = (point.pack(x / cells, y / cells, math.sin(9 * x / cells) * wave) for x in range(side))
            file.write(b"".join(row))
        for y in range(cells):
            corners = range(y * side, y * side + cells)
            row = (faces.pack(3, a, a + 1, a + side + 1, 3, a, a + side + 1, a + side) for a in corners)
            file.write(b"".join(row))


class Memory(unittest.TestCase):
    ground = None

    @classmethod
    def setUpClass(cls):
        cls.ground = Ground()
        cls.addClassCleanup(cls.ground.close)

    def check(self, name, arguments, kind, most):
        limit = lambda: resource.setrlimit(kind, (most, most))
        answer = self.ground.run(arguments, preexec_fn=limit)
        told = f"{name} in {most / MIB:.0f} MiB: {answer.returncode} {answer.stderr}"
        self.assertIn(answer.returncode, (0, 4), told)
        if answer.returncode == 4:
            self.assertEqual(len(answer.stderr.splitlines()), 1, told)
            self.assertIn("memory", answer.stderr, told)
        return answer.returncode

    def test_steps_from_tight_to_loose(self):
        write_grid(self.ground.folder / "mesh.ply", 300 if ALL else 150)
        commands = {
            "reshape": "reshape mesh.ply --remesh never --pin x<=1% --move x>=99%=0.3,0,0 -o out/a.ply",
            "stylize": "stylize mesh.ply --style cube --iterations 1 -o out/a.ply --picture out/a.png",
            "resize": "resize mesh.ply --scale 2,1,1 --grid 20 -o out/a.ply --picture out/a.png",
            "compare": "compare mesh.ply mesh.ply --picture out/a.png --json out/a.json",
            "info": "info mesh.ply --json out/a.json",
        }
        steps = 20 if ALL else 3
        for limited, (kind, most) in LIMITS.items():
            for name, command in commands.items():
                with self.subTest(limited=limited, command=name):
                    for step in range(steps):
                        self.ground.fill({})
                        tight = round(LEAST * (most / LEAST) ** (step / (steps - 1)))
                        # Errors only: a warning is a line too.
                        code = self.check(name, [*command.split(" "), "--quiet"], kind, tight)
                        files = sorted(path.name for path in self.ground.out.iterdir())
                        self.assertEqual([file for file in files if not file.startswith("a.")], [])
                        if code == 0:
                            break

    def test_a_mesh_that_does_not_fit(self):
        for limited, (kind, most) in LIMITS.items():
            write_grid(self.ground.folder / "large.ply", (2500 if kind == resource.RLIMIT_AS else 1500) if ALL else 700)
            for command in (
                "reshape large.ply --remesh never --pin x<=1% --move x>=99%=0.3,0,0 -o out/a.ply",
                "stylize large.ply --style cube --iterations 1 -o out/a.ply",
                "info large.ply --json out/a.json",
            ):
                with self.subTest(limited=limited, command=command):
                    self.ground.fill({"a.ply": b"old", "a.json": b"old"})
                    code = self.check(command, [*command.split(" "), "--quiet"], kind, most if ALL else LEAST)
                    self.assertTrue(code == 0 or set(self.ground.content().values()) == {b"old"})

    def test_too_little_for_its_libraries(self):
        for limited, (kind, _) in LIMITS.items():
            codes = set()
            for most in (192, 256, 320, 384, 448):
                with self.subTest(limited=limited, mib=most):
                    codes.add(self.check("info", ["info", "mesh.obj", "--quiet"], kind, most * MIB))
            self.assertIn(4, codes)

    def test_many_cores(self):
        """For each OpenBLAS would begin a thread as it is loaded, and end the program where these do not fit."""
        for limited, (kind, most) in LIMITS.items():
            with self.subTest(limited=limited):
                new = self.ground.new("reshape")
                self.ground.fill({})
                limit = lambda: resource.setrlimit(kind, (most, most))
                answer = self.ground.run(arguments_of("reshape"), {"LD_PRELOAD": MANY_CORES}, preexec_fn=limit)
                self.assertEqual(answer.returncode, 0, answer.stderr)
                self.assertEqual(self.ground.content().keys(), new.keys())

    def test_few_threads(self):
        """Where no more than one can be started, one does it."""
        for name in COMMANDS if ALL else ("stylize", "template mesh"):
            with self.subTest(command=name):
                new = self.ground.new(name)
                # 60 stacks of 64 MiB do not fit.
                few = lambda: resource.setrlimit(resource.RLIMIT_AS, (2048 * MIB, 2048 * MIB))
                answer = self.ground.run(
                    [*arguments_of(name), "--threads", "60"],
                    {"OMP_STACKSIZE": "8M", "OPENBLAS_NUM_THREADS": "1"},
                    preexec_fn=lambda: (few(), resource.setrlimit(resource.RLIMIT_STACK, (64 * MIB, 64 * MIB))),
                )
                self.assertEqual(answer.returncode, 0, answer.stderr)
                self.assertIn("of 60 threads can be started", answer.stderr)
                self.assertEqual(self.ground.content().keys(), new.keys())


if __name__ == "__main__":
    unittest.main()
