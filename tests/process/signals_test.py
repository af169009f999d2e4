"""SIGINT and SIGTERM, at random moments of every command that writes: each file is the old one or the new one, byte for
byte, and nothing else is left. A second argument is the number of signals sent."""

import random
import signal
import subprocess
import sys
import time
import unittest

TRIES = int(sys.argv.pop(2)) if len(sys.argv) > 2 and sys.argv[2].isdigit() else 40

from commands import COMMANDS, Ground, arguments_of  # pylint: disable=wrong-import-position

# Seconds; a machine that does much else is slow.
LONGEST_WAIT = 60


class Signals(unittest.TestCase):
    def test_at_random_moments(self):
        ground = Ground()
        self.addCleanup(ground.close)
        chance = random.Random(1)
        names = list(COMMANDS)
        seconds, codes = {}, {}
        for k in range(TRIES):
            name = names[k % len(names)]
            ground.new(name)
            if name not in seconds:
                start = time.monotonic()
                ground.run(arguments_of(name)).check_returncode()
                seconds[name] = time.monotonic() - start
            number = (signal.SIGINT, signal.SIGTERM)[k // len(names) % 2]
            # A quarter come after another one, so that the program ends at once, wherever it is.
            twice = chance.random() < 0.25
            ground.fill_with_old(name)
            with ground.start(arguments_of(name)) as running:
                time.sleep(chance.uniform(0, 1.05 * seconds[name]))
                running.send_signal(number)
                if twice:
                    time.sleep(chance.uniform(0, 0.02))
                    running.send_signal(number)
                try:
                    err = running.communicate(timeout=LONGEST_WAIT)[1].decode()
                except subprocess.TimeoutExpired:
                    running.kill()
                    self.fail(f"{name} goes on after signal {number}")
            told = f"try {k}, {name}: {running.returncode} {err}"
            # Before the program watches for signals, they end it as they end any.
            self.assertIn(running.returncode, (0, 130, -number), told)
            self.assertEqual(ground.halves(name), [], told)
            codes[running.returncode] = codes.get(running.returncode, 0) + 1
        print("exit codes:", codes, file=sys.stderr)
        self.assertGreater(codes.get(130, 0), 0)


if __name__ == "__main__":
    unittest.main()
