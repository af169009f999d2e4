"""The program, the test's first argument, and each of its commands that write, on small meshes of its own making."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else "swage"

# Results go to the folder out. Small ones: a second each, where nothing else runs.
COMMANDS = {
    "reshape": "reshape mesh.obj --pin x<=1% --move x>=99%=0.3,0,0 -o out/mesh.obj --json out/report.json",
    "deform": "reshape mesh.obj --method arap --pin x<=1% --move x>=99%=0.3,0,0 -o out/mesh.ply",
    "stylize": "stylize mesh.obj --style cube --iterations 3 -o out/mesh.stl --picture out/mesh.png --size 300x200",
    "developable": "stylize mesh.obj --developable --iterations 3 -o out/mesh.obj",
    "resize": "resize mesh.obj --scale 2,1,1 --grid 12 -o out/mesh.off --picture out/mesh.png --picture-size 300x200"
    " --vulnerability out/map.ply --grid-after out/grid.ply",
    "template mesh": "template mesh couch --resolution 16 -o out/mesh.obj --json out/report.json",
    "template fit": "template fit box.obj --template box --up y --no-turns --samples 200 --volume-samples 200"
    " --sigmas 1 --fit-iterations 5 --json out/fit.json --picture out/fit.png --picture-size 300x200",
    "template edit": "template edit mesh.obj --fit fit.json --set width*=1.2 --passes 5 -o out/mesh.obj"
    " --json out/fit.json",
    "template retarget": "template retarget mesh.obj edit.obj --source-fit fit.json --target-fit fit.json --passes 3"
    " -o out/mesh.obj",
    "template interpolate": "template interpolate mesh.obj --fit fit.json --set width*=1.2 --passes 5 --frames 3"
    " -o out/frame.obj",
    "compare": "compare mesh.obj edit.obj --json out/report.json --faces out/faces.ply --picture out/edit.png"
    " --size 300x200",
    "info": "info mesh.obj --json out/report.json --straight out/straight",
    "demo": "demo out",
}

OLD = b"as it was\n"


def arguments_of(name):
    return COMMANDS[name].split(" ")


class Ground:
    """A folder with what the commands read, and the folder out for what they write."""

    def __init__(self):
        self._kept = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._kept.name)
        self.out = self.folder / "out"
        self.out.mkdir()
        self._new = {}
        for made in (
            "template mesh couch --resolution 16 -o mesh.obj",
            "template mesh box --resolution 8 -o box.obj",
            "template fit mesh.obj --template couch --up y --no-turns --samples 100 --volume-samples 0 --sigmas 1"
            " --fit-iterations 1 --json fit.json",
            "stylize mesh.obj --style cube --iterations 1 -o edit.obj",
        ):
            self.run(made.split(" ")).check_returncode()

    def close(self):
        self._kept.cleanup()

    def environment(self, **more):
        """On two threads that sleep while they wait, whatever else runs here."""
        return {**os.environ, "OMP_NUM_THREADS": "2", "OMP_WAIT_POLICY": "passive", "SWAGE_BACKEND": "cpu", **more}

    def start(self, arguments, environment=None, **options):
        environment = self.environment(**(environment or {}))
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "cwd": self.folder, **options}
        return subprocess.Popen([PROGRAM, *arguments], env=environment, **pipes)

    def run(self, arguments, environment=None, **options):
        """What a run that has ended said, as text; one that hangs fails."""
        with self.start(arguments, environment, **options) as running:
            try:
                out, err = running.communicate(timeout=300)
            except subprocess.TimeoutExpired:
                running.kill()
                raise
        told = [b"" if text is None else text for text in (out, err)]
        return subprocess.CompletedProcess(arguments, running.returncode, *(text.decode() for text in told))

    def run_shell(self, line):
        return subprocess.run(line, shell=True, cwd=self.folder, env=self.environment(), check=False, timeout=300)

    def new(self, name):
        """What the command writes where nothing hinders it: the content by the file's name."""
        if name not in self._new:
            self.fill({})
            self.run(arguments_of(name)).check_returncode()
            self._new[name] = self.content()
        return self._new[name]

    def fill(self, content):
        for path in self.out.iterdir():
            path.unlink()
        for file, text in content.items():
            (self.out / file).write_bytes(text)

    def content(self):
        return {path.name: path.read_bytes() for path in self.out.iterdir()}

    def fill_with_old(self, name):
        self.fill({file: OLD for file in self.new(name)})

    def halves(self, name):
        """Files in out that are neither the old ones nor the new ones."""
        new = self.new(name)
        return [file for file, text in self.content().items() if text != OLD and not is_new(file, text, new)]


def is_new(file, text, new):
    """Reports hold seconds: they are whole where they can be read, and have the same entries."""
    if file not in new or not file.endswith(".json"):
        return text == new.get(file)
    try:
        return json.loads(text).keys() == json.loads(new[file]).keys()
    except ValueError:
        return False
