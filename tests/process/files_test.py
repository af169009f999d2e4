"""Files that cannot be written as asked for: exit code, one line that names the file, and what was there before."""

import os
import pathlib
import resource
import subprocess
import tempfile
import unittest

from commands import OLD, PROGRAM, Ground, arguments_of

MESH = "template mesh couch --resolution 16 --quiet -o"


class Files(unittest.TestCase):
    ground = None

    @classmethod
    def setUpClass(cls):
        cls.ground = Ground()
        cls.addClassCleanup(cls.ground.close)

    def setUp(self):
        self.out = self.ground.out
        self.ground.fill({})

    def mesh_to(self, path, **options):
        return self.ground.run([*MESH.split(" "), str(path)], **options)

    def assert_refused(self, answer, code, *words):
        self.assertEqual(answer.returncode, code, answer.stderr)
        self.assertEqual(len(answer.stderr.splitlines()), 1, answer.stderr)
        for word in words:
            self.assertIn(word, answer.stderr)

    def test_a_full_disk(self):
        with tempfile.TemporaryDirectory() as folder:
            mounted = subprocess.run(
                ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", folder], capture_output=True, check=False
            )
            if mounted.returncode != 0:
                self.skipTest("no file system can be mounted here; those of root tell")
            try:
                path = pathlib.Path(folder) / "mesh.obj"
                path.write_bytes(OLD)
                self.assert_refused(self.mesh_to(path), 4, str(path), "No space left")
                self.assertEqual(os.listdir(folder), ["mesh.obj"])
                self.assertEqual(path.read_bytes(), OLD)
            finally:
                subprocess.run(["umount", folder], check=True)

    def test_a_full_device(self):
        self.assert_refused(self.mesh_to("/dev/full"), 2, "/dev/full")  # No format by that name.
        report = self.ground.run("template mesh couch --resolution 16 --quiet --json /dev/full".split(" "))
        self.assert_refused(report, 4, "/dev/full", "No space left")
        with open("/dev/full", "wb") as full:
            self.assert_refused(self.mesh_to("-", stdout=full), 4, "stdout")
        (self.out / "mesh.obj").symlink_to("/dev/full")
        self.assert_refused(self.mesh_to("out/mesh.obj"), 4, "out/mesh.obj, a link: /dev/full", "No space left")

    def test_a_limit_of_size(self):
        for name in ("stylize", "resize", "template mesh"):
            with self.subTest(command=name):
                self.ground.fill_with_old(name)
                small = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
                answer = self.ground.run([*arguments_of(name), "--quiet"], preexec_fn=small)
                self.assert_refused(answer, 4, "out/mesh", "File too large")
                self.assertEqual(self.ground.halves(name), [])
                self.assertEqual((self.out / next(iter(self.ground.new(name)))).read_bytes(), OLD)

    def test_folders(self):
        self.assert_refused(self.mesh_to("missing/mesh.obj"), 2, "missing", "no folder")
        (self.ground.folder / "a.obj").mkdir()
        self.assert_refused(self.mesh_to("a.obj"), 2, "a.obj", "folder")
        self.assertEqual(os.listdir(self.ground.folder / "a.obj"), [])

    def test_a_folder_that_cannot_be_written_to(self):
        if os.geteuid() != 0:
            self.out.chmod(0o555)
            self.addCleanup(self.out.chmod, 0o755)
            self.assert_refused(self.mesh_to("out/mesh.obj"), 4, "out/mesh.obj", "Permission denied")
        else:  # To root none is closed, but for such as the kernel's own.
            self.assert_refused(self.mesh_to("/proc/mesh.obj"), 4, "/proc/mesh.obj", "check the folder")

    def test_the_input(self):
        """May be the output too."""
        arguments = "stylize mesh.obj --style cube --iterations 2 --quiet -o".split(" ")
        source = self.ground.folder / "mesh.obj"
        before = source.read_bytes()
        self.addCleanup(source.write_bytes, before)
        self.assertEqual(self.ground.run([*arguments, "out/mesh.obj"]).returncode, 0)
        self.assertEqual(self.ground.run([*arguments, "mesh.obj"]).returncode, 0)
        self.assertEqual(source.read_bytes(), (self.out / "mesh.obj").read_bytes())
        self.assertNotEqual(source.read_bytes(), before)

    def test_links_and_permissions(self):
        real, link, other = self.out / "real.obj", self.out / "link.obj", self.out / "other.obj"
        real.write_bytes(OLD)
        real.chmod(0o640)
        owner = (12345, 54321) if os.geteuid() == 0 else (os.geteuid(), os.getegid())
        os.chown(real, *owner)
        os.link(real, other)
        link.symlink_to("real.obj")
        self.assertEqual(self.mesh_to("out/link.obj").returncode, 0)
        self.assertTrue(link.is_symlink())
        self.assertTrue(b"v " in real.read_bytes())
        state = real.stat()
        self.assertEqual((state.st_mode & 0o777, state.st_uid, state.st_gid), (0o640, *owner))
        self.assertEqual(other.read_bytes(), OLD)
        self.assertEqual(sorted(os.listdir(self.out)), ["link.obj", "other.obj", "real.obj"])

    def test_a_reader_that_leaves(self):
        for closes_first in (True, False):
            with self.subTest(closes_first=closes_first):
                reader, writer = os.pipe()
                if closes_first:
                    os.close(reader)
                # More than a pipe holds.
                arguments = "template mesh couch --resolution 64 --quiet -o - --json out/report.json".split(" ")
                with self.ground.start(arguments, stdout=writer) as running:
                    os.close(writer)
                    if not closes_first:
                        os.read(reader, 100)
                        os.close(reader)
                    err = running.communicate(timeout=300)[1].decode()
                answer = subprocess.CompletedProcess(arguments, running.returncode, "", err)
                self.assert_refused(answer, 4, "stdout", "does somebody read it")
                self.assertEqual(os.listdir(self.out), [])

    def test_closed_streams(self):
        """What is opened next is not taken for them."""
        command = f'"{PROGRAM}" template mesh couch --resolution 16 -o out/mesh.obj -v'
        for closed in ("2>&-", "<&- >&- 2>&-"):
            with self.subTest(closed=closed):
                self.ground.fill({})
                answer = self.ground.run_shell(f"{command} {closed}")
                self.assertEqual(answer.returncode, 0)
                self.assertEqual(self.ground.content()["mesh.obj"], self.ground.new("template mesh")["mesh.obj"])
        self.assertEqual(self.ground.run_shell(f'"{PROGRAM}" template list >&-').returncode, 4)


if __name__ == "__main__":
    unittest.main()
