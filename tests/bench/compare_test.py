"""bench/compare: what it calls slower, and what it answers."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

COMPARE = pathlib.Path(__file__).resolve().parents[2] / "bench" / "compare"


def result(folder, name, times_in_ms):
    path = pathlib.Path(folder) / name
    entries = [
        {"name": benchmark, "run_type": "iteration", "real_time": time, "time_unit": "ms"}
        for benchmark, times in times_in_ms.items()
        for time in times
    ]
    path.write_text(json.dumps({"benchmarks": entries}), encoding="utf-8")
    return str(path)


class Compare(unittest.TestCase):
    def compare(self, a, b):
        with tempfile.TemporaryDirectory() as folder:
            files = [result(folder, "a.json", a), result(folder, "b.json", b)]
            return subprocess.run([sys.executable, str(COMPARE), *files], capture_output=True, text=True, check=False)

    def line(self, answer, name):
        return next(line for line in answer.stdout.splitlines() if line.startswith(name))

    def test_slower_by_both_thresholds(self):
        answer = self.compare({"x": [10]}, {"x": [13]})
        self.assertEqual(answer.returncode, 1)
        self.assertIn("1.30", self.line(answer, "x"))
        self.assertTrue(self.line(answer, "x").endswith("slower"))

    def test_a_small_part_is_noise(self):
        self.assertEqual(self.compare({"x": [10]}, {"x": [11.5]}).returncode, 0)

    def test_a_small_time_is_noise(self):
        self.assertEqual(self.compare({"x": [0.1]}, {"x": [0.4]}).returncode, 0)

    def test_faster_is_no_failure(self):
        answer = self.compare({"x": [10]}, {"x": [5]})
        self.assertEqual(answer.returncode, 0)
        self.assertTrue(self.line(answer, "x").endswith("faster"))

    def test_of_repeated_runs_the_fastest_counts(self):
        self.assertEqual(self.compare({"x": [10, 30]}, {"x": [40, 10]}).returncode, 0)

    def test_names_what_only_one_has(self):
        answer = self.compare({"x": [1], "old": [1]}, {"x": [1], "new": [1]})
        self.assertIn("old: only in A", answer.stdout)
        self.assertIn("new: only in B", answer.stdout)

    def test_nothing_to_compare(self):
        self.assertEqual(self.compare({"x": [1]}, {"y": [1]}).returncode, 2)


if __name__ == "__main__":
    unittest.main()
