"""bench/corpus: what it runs, and what it complains of. The program is the only argument."""

import csv
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

CORPUS = pathlib.Path(__file__).resolve().parents[2] / "bench" / "corpus"
SWAGE = sys.argv.pop() if len(sys.argv) > 1 else "swage"

TETRAHEDRON = """v 0 0 0
v 2 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
"""
FLAT = "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"
BROKEN = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"


class Corpus(unittest.TestCase):
    def corpus(self, meshes, *arguments):
        """Answer and rows of `meshes`: a class and a text by name."""
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            with open(folder / "index.csv", "w", newline="", encoding="utf-8") as index:
                writer = csv.writer(index)
                writer.writerow(["file", "class"])
                for name, (letter, text) in meshes.items():
                    writer.writerow([f"all/{name}", letter])
                    (folder / name).write_text(text, encoding="utf-8")
            kept = folder / "rows.json"
            command = [sys.executable, str(CORPUS), SWAGE, place, "--json", str(kept), "--options=--remesh never"]
            command += arguments
            answer = subprocess.run(command, capture_output=True, text=True, check=False)
            rows = json.loads(kept.read_text(encoding="utf-8"))["runs"] if kept.exists() else []
            return answer, rows

    def test_runs_all_gestures(self):
        answer, rows = self.corpus({"one.obj": ("A", TETRAHEDRON)})
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        self.assertEqual([row["gesture"] for row in rows], ["along-x", "along-y", "along-z", "widen", "move"])
        for row in rows:
            self.assertEqual(row["triangles"], 4)
            self.assertLess(row["handle_percent"], 1)
            self.assertEqual(row["new_crossings"], 0)
        self.assertIn("class A: meshes 1, runs 5, right 5,", answer.stdout)

    def test_leaves_out_what_a_flat_mesh_has_not(self):
        answer, rows = self.corpus({"flat.obj": ("B", FLAT)})
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        self.assertEqual([row["gesture"] for row in rows], ["along-y", "along-z"])

    def test_malformed_ones_are_to_be_refused(self):
        answer, rows = self.corpus({"broken.obj": ("X", BROKEN)})
        self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
        self.assertEqual(rows[0]["path"], "refused")

    def test_complains_where_a_malformed_one_is_taken(self):
        answer, rows = self.corpus({"one.obj": ("X", TETRAHEDRON)})
        self.assertEqual(answer.returncode, 1)
        self.assertIn("exit 0", rows[0]["wrong"])
        self.assertIn("leaves report.json, result.ply", "; ".join(rows[0]["wrong"]))

    def test_complains_where_a_mesh_is_refused(self):
        answer, rows = self.corpus({"broken.obj": ("A", BROKEN)})
        self.assertEqual(answer.returncode, 1)
        self.assertEqual(rows[0]["wrong"], ["refused"])

    def test_nothing_to_run(self):
        answer, _ = self.corpus({"one.obj": ("A", TETRAHEDRON)}, "--only", "none")
        self.assertEqual(answer.returncode, 2)


if __name__ == "__main__":
    unittest.main()
