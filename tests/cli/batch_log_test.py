"""What batch says: lines for people, one JSON object a line for programs, nothing with --quiet."""

import json
import os
import pty
import subprocess
import unittest

from batch_test import SMALL
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

    def test_quiet_leaves_errors_alone(self):
        quiet = self.run_batch("-q")
        self.assertEqual((quiet.stdout, len(quiet.stderr.splitlines())), ("", 1), quiet.stderr)
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"})
        for words in (["-q"], ["-q", "--all"]):  # what is known to be current goes a shorter way
            quiet = self.run_batch(*words)
            self.assertEqual((quiet.returncode, quiet.stdout, quiet.stderr), (0, "", ""), words)

    def test_a_failure_is_told_once_where_there_is_one_entry(self):
        self.assertIn("failed: packs/none", self.run_batch().stdout)
        self.manifest({"sample": "missing.png", "output": "packs/none"})
        alone = self.run_batch()
        self.assertEqual(alone.stdout, "1 entry: 1 failed\n")
        self.assertEqual(len(alone.stderr.splitlines()), 1)

    def test_verdicts_and_notes_are_told(self):
        self.noise_png("in/flat.png", 16, 16, seed=3)
        self.manifest({"sample": "in/flat.png", "output": "packs/flat", "options": {**SMALL, "tile-size": "auto"}},
                      {"sample": "in/a.png", "output": "packs/a"})
        events = [json.loads(line) for line in self.run_batch("--log-format", "json").stdout.splitlines()]
        done = {event["entry"]: event for event in events if event["event"] == "done"}
        self.assertIn(done["packs/flat"]["verdict"], ("fair", "poor"))
        self.assertRegex(done["packs/flat"]["remarks"][0], r"\w+ .*\.")
        self.assertTrue(any("no repeat was found" in note for note in done["packs/flat"]["notes"]), done["packs/flat"])
        self.assertIn("verdict", done["packs/a"])
        self.assertNotIn("notes", done["packs/a"])
        plain = self.run_batch("--all").stderr.splitlines()
        line = next(line for line in plain if "packs/flat: built" in line)
        self.assertRegex(line, r"built in [\d.]+ s \(asked for\): (fair|poor)$")
        told = self.run_batch("--all", "-v").stderr
        self.assertIn(f": {done['packs/flat']['verdict']} ({done['packs/flat']['remarks'][0]})", told)
        self.assertIn("packs/flat: no repeat was found", told)

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
