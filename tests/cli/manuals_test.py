"""Manual pages and completion: of every verb and option, as the program is now, and taken by the shells."""

import os
import re
import shutil
import subprocess
import unittest

from command import TILEPACK, CommandCase

MADE = os.path.join(os.path.dirname(TILEPACK), "made")


class Manuals(CommandCase):
    def setUp(self):
        super().setUp()
        listing = self.run_tilepack("help").stdout
        self.verbs = [v for v in re.findall(r"^  ([a-z]+) ", listing.split("Verbs:")[1].split("\n\n")[0], re.MULTILINE) if v != "help"]
        self.options = {}
        for verb in self.verbs:
            manual = self.run_tilepack("help", verb).stdout.split("\nExample:")[0]
            self.options[verb] = sorted(set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z-]+)", manual)))
            self.assertIn("--help", self.options[verb])

    def printed(self, *words):
        return self.run_tilepack("help", *words).stdout

    def need(self, program):
        if shutil.which(program) is None:
            self.skip(f"{program} is not here")

    def test_pages_name_every_option(self):
        everything = self.printed("--man")
        for verb in self.verbs:
            self.assertIn(f"tilepack\\-{verb}", everything)
            page = self.printed("--man", verb).replace("\\-", "-")
            for option in self.options[verb]:
                self.assertIn(f"\\fB{option}\\fR", page, verb)
            self.assertIn(f"tilepack {verb}", page.split(".SH EXAMPLES")[1])

    def test_what_the_build_made_is_current(self):
        pages = {"man1/tilepack.1": ["--man"], **{f"man1/tilepack-{verb}.1": ["--man", verb] for verb in self.verbs},
                 "completion/bash/tilepack": ["--completion", "bash"], "completion/zsh/_tilepack": ["--completion", "zsh"],
                 "completion/fish/tilepack.fish": ["--completion", "fish"]}
        found = sorted(os.path.relpath(os.path.join(folder, name), MADE) for folder, _, names in os.walk(MADE) for name in names)
        self.assertEqual(found, sorted(pages))
        for name, words in pages.items():
            with open(os.path.join(MADE, name), encoding="utf-8") as stream:
                self.assertEqual(stream.read(), self.printed(*words), name)

    def test_groff_reads_the_pages(self):
        self.need("groff")
        for verb in self.verbs:
            done = subprocess.run(["groff", "-Kutf8", "-man", "-Tutf8", "-ww"], input=self.printed("--man", verb), capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""), verb)
            self.assertIn("User Commands", done.stdout)

    def test_bash(self):
        self.write("completion", self.printed("--completion", "bash"))

        def completed(*words):
            line = " ".join(f"'{word}'" for word in words)
            script = f"source ./completion; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _tilepack; printf '%s\\n' \"${{COMPREPLY[@]}}\""
            done = subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.stderr, "")
            return sorted(done.stdout.split())

        self.assertEqual(completed("tilepack", ""), sorted([*self.verbs, "help", "--version"]))
        self.assertEqual(completed("tilepack", "va"), ["validate"])
        for verb in self.verbs:
            self.assertLessEqual(set(self.options[verb]), set(completed("tilepack", verb, "--")), verb)
        self.assertEqual(completed("tilepack", "batch", "m.json", "--emit", ""), ["make", "ninja"])
        self.noise_png("sample.png", 4, 4)
        self.assertEqual(completed("tilepack", "bake", "sam"), ["sample.png"])

    def test_zsh(self):
        self.need("zsh")
        self.write("_tilepack", self.printed("--completion", "zsh"))
        done = subprocess.run(["zsh", "-n", "_tilepack"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        text = self.printed("--completion", "zsh")
        for verb in self.verbs:
            part = text.split(f"\n    {verb})\n")[1].split(";;")[0]
            for option in self.options[verb]:
                self.assertIn(f"'*{option}[", part, verb)
        # What is completed, with _arguments itself told to print what it got.
        script = "_arguments() { print -l -- $@ }; words=(tilepack batch ''); CURRENT=3; source ./_tilepack"
        done = subprocess.run(["zsh", "-f", "-c", script], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("*--emit[", done.stdout)
        self.assertNotIn("--coloring", done.stdout)

    def test_fish(self):
        self.need("fish")
        self.write("tilepack.fish", self.printed("--completion", "fish"))

        def completed(line):
            done = subprocess.run(["fish", "--no-config", "-c", f"source tilepack.fish; complete -C '{line}'"], cwd=self.folder,
                                  capture_output=True, text=True, env={**os.environ, "HOME": self.folder})
            self.assertEqual(done.stderr, "")
            return sorted(entry.split("\t")[0] for entry in done.stdout.splitlines())

        self.assertEqual(completed("tilepack val"), ["validate"])
        for verb in self.verbs:
            self.assertLessEqual(set(self.options[verb]), set(completed(f"tilepack {verb} --")), verb)
        self.assertEqual(completed("tilepack batch --emit "), ["make", "ninja"])

    def test_words_that_are_wrong(self):
        self.run_tilepack("help", "--completion", "csh", code=1)
        self.run_tilepack("help", "--man", "bakee", code=1)


if __name__ == "__main__":
    unittest.main()
