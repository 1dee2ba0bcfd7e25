"""What batch says: lines for people, one JSON object a line for programs, nothing with --quiet."""

import json
import os
import pty
import subprocess
import unittest

from batch_test import Batch as BatchCase
from command import SOURCE, TILEPACK


class Log(BatchCase):
    def setUp(self):
        super().setUp()
        self.samples("a", "b")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"}, {"sample": "missing.png", "output": "packs/none"},
                      {"verb": "render", "pack": "packs/none", "output": "none.png"})

    def run_batch(self, *words):
        return subprocess.run([TILEPACK, "batch", "m.json", *words], cwd=self.folder, capture_output=True, text=True)

    def test_json_keeps_its_schema(self):
        import jsonschema
        with open(os.path.join(SOURCE, "lib/tilepack/batch/batch_log.schema.json"), encoding="utf-8") as stream:
            schema = json.load(stream)
        jsonschema.Draft7Validator.check_schema(schema)
        done = self.run_batch("--log-format", "json")
        self.assertEqual((done.returncode, done.stderr), (2, ""))
        events = [json.loads(line) for line in done.stdout.splitlines()]
        for event in events:
            jsonschema.validate(event, schema)
        self.assertEqual({event["event"] for event in events}, {"start", "progress", "done", "failed", "end"})
        self.assertEqual(events[-1]["built"], 2)
        self.assertEqual([event["code"] for event in events if event["event"] == "failed"], [2])
        self.assertGreater(events[-2]["peak_memory"], 1 << 20)
        with self.assertRaises(jsonschema.ValidationError):
            jsonschema.validate({**events[-1], "more": 1}, schema)

    def test_lines_for_people(self):
        done = self.run_batch()
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 4, lines)
        self.assertEqual(sum("built in" in line and "(not built yet)" in line for line in lines), 2)
        self.assertNotIn("\x1b", done.stderr + done.stdout)
        self.assertEqual(len(self.run_batch("-v").stderr.splitlines()), 4)
        quiet = self.run_batch("--quiet")
        self.assertEqual(len(quiet.stderr.splitlines()), 1)  # errors are always told

    def test_a_terminal_gets_a_line_an_entry_and_a_total(self):
        self.manifest({"samples": "in/*.png", "options": {"effort": 9, "colors": "3"}, "output": "packs/{stem}"})
        ours, theirs = pty.openpty()
        process = subprocess.Popen([TILEPACK, "batch", "m.json", "--jobs", "2"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=theirs,
                                   env={**os.environ, "NO_COLOR": "1"})
        os.close(theirs)
        text = b""
        try:
            while chunk := os.read(ours, 65536):
                text += chunk
        except OSError:  # how a terminal ends
            pass
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        self.assertRegex(text.decode(), r"\d+ % \S.* packs/a")
        self.assertIn("of 2 done", text.decode())
        self.assertNotIn("\x1b[33m", text.decode())


del BatchCase

if __name__ == "__main__":
    unittest.main()
