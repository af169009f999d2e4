"""The schema of templates: shipped ones are valid, broken ones are not. The folder with the schema is the argument."""

import json
import pathlib
import sys
import unittest

import jsonschema

FOLDER = pathlib.Path(sys.argv.pop())
BROKEN = pathlib.Path(__file__).resolve().parent / "broken.json"


def loaded(path):
    return json.loads(path.read_text(encoding="utf-8"))


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        schema = loaded(FOLDER / "template.schema.json")
        jsonschema.Draft202012Validator.check_schema(schema)
        cls.validator = jsonschema.Draft202012Validator(schema)

    def test_shipped_are_valid(self):
        paths = sorted((FOLDER / "shipped").glob("*.json"))
        self.assertGreater(len(paths), 8)
        for path in paths:
            errors = [f"{error.json_path}: {error.message}" for error in self.validator.iter_errors(loaded(path))]
            self.assertEqual(errors, [], path.name)

    def test_broken_are_not(self):
        for broken in loaded(BROKEN):
            self.assertFalse(self.validator.is_valid(broken["template"]), broken["why"])


if __name__ == "__main__":
    unittest.main()
