"""Any allocation may fail, and all after it: the program ends with one line that says so, and no file is half.

The second argument is the library that makes them fail; a third is how many are tried of each command."""

import random
import sys
import unittest

LIBRARY = sys.argv.pop(2)
TRIES = int(sys.argv.pop(2)) if len(sys.argv) > 2 and sys.argv[2].isdigit() else 5

from commands import COMMANDS, Ground, arguments_of  # pylint: disable=wrong-import-position

# Bytes. What is less is there as long as anything is.
SIZE = "4096"


class Allocations(unittest.TestCase):
    def test_any_may_fail(self):
        ground = Ground()
        self.addCleanup(ground.close)
        chance = random.Random(1)
        for name in COMMANDS:
            with self.subTest(command=name):
                ground.new(name)
                arguments = [*arguments_of(name), "--quiet"]
                preloaded = {"LD_PRELOAD": LIBRARY, "FAIL_SIZE": SIZE}
                counted = ground.run(arguments, preloaded).stderr
                total = int(counted.split("allocations: ")[1])
                self.assertGreater(total, 50)
                failed = 0
                for step in range(TRIES):
                    first = 1 + int(total * (step + chance.random()) / TRIES)
                    ground.fill_with_old(name)
                    answer = ground.run(arguments, {**preloaded, "FAIL_AT": str(first)})
                    told = f"{name}, {first} of {total}: {answer.returncode} {answer.stderr}"
                    self.assertEqual(ground.halves(name), [], told)
                    if answer.returncode == 0:
                        continue
                    failed += 1
                    self.assertEqual(answer.returncode, 4, told)
                    self.assertEqual(len(answer.stderr.splitlines()), 1, told)
                    self.assertIn("memory", answer.stderr, told)
                # The last ones of all may be those of threads that come otherwise.
                self.assertGreaterEqual(failed, TRIES - 1)


if __name__ == "__main__":
    unittest.main()
