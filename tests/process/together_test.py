"""Two programs that write the same file at once: it is what one of them wrote, byte for byte."""

import unittest

from commands import Ground

ROUNDS = 8


class Together(unittest.TestCase):
    def test_the_result_is_one_of_the_two(self):
        ground = Ground()
        self.addCleanup(ground.close)
        runs = [
            f"template mesh couch --resolution 64 --set width*={factor} -o out/mesh.obj".split(" ")
            for factor in ("1.1", "1.2")
        ]
        alone = []
        for arguments in runs:
            ground.run(arguments).check_returncode()
            alone.append((ground.out / "mesh.obj").read_bytes())
        self.assertNotEqual(*alone)
        for _ in range(ROUNDS):
            at_once = [ground.start(arguments) for arguments in runs]
            for running in at_once:
                with running:
                    err = running.communicate(timeout=300)[1].decode()
                self.assertEqual(running.returncode, 0, err)
            content = ground.content()
            self.assertEqual(list(content), ["mesh.obj"])
            self.assertIn(content["mesh.obj"], alone)


if __name__ == "__main__":
    unittest.main()
