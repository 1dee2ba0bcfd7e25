"""tilepack batch --cache: finished outputs by content, for clean checkouts and other machines; damage is made good."""

import os
import shutil
import subprocess
import unittest

from batch_test import Batch
from command import SOURCE, TILEPACK


class Cache(Batch):
    def setUp(self):
        super().setUp()
        self.samples("a", "b", "c")
        self.manifest({"samples": "in/*.png", "output": "packs/{stem}"},
                      {"verb": "render", "pack": "packs/a", "output": "previews/a.png"},
                      {"verb": "validate", "pack": "packs/a", "output": "a.txt"})
        self.assertEqual(self.counts("m.json", "--cache", "cache"), {"built": 5})
        self.good = self.outputs()

    def outputs(self):
        return {name: data for name, data in self.contents().items()
                if data is not None and name.startswith(("packs/", "previews/", "a.txt"))}

    def cached(self):
        return [os.path.join(folder, name) for folder, _, names in os.walk(self.path("cache")) for name in names]

    def bytes_of(self, file):
        with open(file, "rb") as stream:
            return stream.read()

    def forget(self):
        for name in ("packs", "previews"):
            shutil.rmtree(self.path(name), ignore_errors=True)
        for name in ("a.txt", ".a.txt.build", ".m.json.index"):
            if os.path.exists(self.path(name)):
                os.remove(self.path(name))

    def test_a_clean_checkout_bakes_nothing(self):
        self.assertEqual(len(self.cached()), 5)
        self.forget()
        self.assertEqual(self.counts("m.json", "--cache", "cache"), {"restored": 5})
        self.assertEqual(self.outputs(), self.good)
        self.assertEqual(self.counts("m.json"), {"current": 5})

    def test_another_folder_and_other_names_too(self):
        os.makedirs(self.path("other/in"))
        for old, new in (("a", "x"), ("b", "y"), ("c", "z")):
            shutil.copy(self.path(f"in/{old}.png"), self.path(f"other/in/{new}.png"))
        self.manifest({"samples": "in/*.png", "output": "out/{stem}"}, name="other/m.json")
        self.assertEqual(self.counts("other/m.json", "--cache", "cache"), {"restored": 3})
        self.assertEqual(self.contents("other/out/x").values().__len__(), len([n for n in self.good if n.startswith("packs/a/")]))

    def test_what_is_damaged_is_made_again(self):
        files = sorted(self.cached())
        for i, file in enumerate(files):
            with open(file, "rb") as stream:
                data = stream.read()
            with open(file, "wb") as stream:  # cut short, emptied, one bit in the head or the middle or the end
                stream.write((data[:-1], b"", bytes([data[0] ^ 1]) + data[1:], data[:len(data) // 2] + bytes([data[len(data) // 2] ^ 1]) +
                              data[len(data) // 2 + 1:], data[:-1] + bytes([data[-1] ^ 1]))[i % 5])
        self.forget()
        self.assertEqual(self.counts("m.json", "--cache", "cache"), {"built": 5})
        self.assertEqual(self.outputs(), self.good)
        self.forget()
        self.assertEqual(self.counts("m.json", "--cache", "cache"), {"restored": 5})

    def test_it_keeps_what_was_used_last(self):
        for age, file in enumerate(sorted(self.cached())):
            os.utime(file, (1000 + age, 1000 + age))
        sizes = {file: os.path.getsize(file) for file in self.cached()}
        oldest = min(sizes, key=os.path.getmtime)
        shutil.rmtree(self.path("packs/b"))
        self.assertEqual(self.counts("m.json", "--cache", "cache", "--cache-size", sum(sizes.values()) - 1), {"restored": 1, "current": 4})
        left = set(self.cached())
        self.assertEqual(len(left), 4)
        used = {file for file in left if os.path.getmtime(file) > 10000}
        self.assertEqual(len(used), 1)  # what was just used stays, even if it was the oldest
        self.assertTrue(oldest not in left or oldest in used)

    def test_a_cache_that_takes_nothing_is_a_warning(self):
        self.write("full", "no folder")
        self.forget()
        done = subprocess.run([TILEPACK, "batch", "m.json", "--cache", "full"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not kept in the cache", done.stderr)
        self.run_tilepack("batch", "m.json", "--cache-size", "1G", code=1)

    def test_many_writers(self):
        self.forget()
        shutil.rmtree(self.path("cache"))
        runs = []
        for i in range(4):
            os.makedirs(self.path(f"w{i}/in"))
            for name in "abc":
                shutil.copy(self.path(f"in/{name}.png"), self.path(f"w{i}/in/{name}.png"))
            self.manifest({"samples": "in/*.png", "output": "packs/{stem}"}, name=f"w{i}/m.json")
            runs.append(subprocess.Popen([TILEPACK, "batch", f"w{i}/m.json", "--cache", "cache", "--jobs", "1", "--quiet"],
                                         cwd=self.folder, stdout=subprocess.DEVNULL))
        self.assertEqual([run.wait() for run in runs], [0] * 4)
        self.assertEqual(len(self.cached()), 3)
        for i in range(1, 4):
            self.assertEqual(*({os.path.basename(n): d for n, d in self.contents(f"w{k}/packs/a").items()} for k in (0, i)))

    def test_a_share_that_fails_now_and_then(self):
        """A stand-in for NFS: handles go stale, disks are full, answers get lost; three machines write at once."""
        faults = self.path("share_faults.so")
        source = os.path.join(SOURCE, "tests", "cli", "share_faults.c")
        if os.environ.get("TILEPACK_SANITIZED") == "1":
            self.skipTest("the sanitizers must be loaded first")
        if subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", faults, source, "-ldl"], check=False).returncode:
            self.skip("there is no compiler of C")
        kept = {os.path.basename(file): self.bytes_of(file) for file in self.cached()}
        for i in range(3):
            shutil.copytree(self.path("in"), self.path(f"w{i}/in"))
            self.manifest({"samples": "in/*.png", "output": "packs/{stem}"}, name=f"w{i}/m.json")
        whole = {f"w{i}/{name}": data for i in range(3) for name, data in self.good.items() if name.startswith("packs/")}
        warned = restored = 0
        for seed in range(12):
            if seed % 2 == 0:
                shutil.rmtree(self.path("cache"))
            for i in range(3):
                shutil.rmtree(self.path(f"w{i}/packs"), ignore_errors=True)
            share = {"LD_PRELOAD": faults, "SHARE_FOLDER": self.path("cache"), "SHARE_SEED": str(seed), "SHARE_ODDS": "50"}
            runs = [subprocess.Popen([TILEPACK, "batch", f"w{i}/m.json", "--cache", "cache", "--jobs", "1"], cwd=self.folder, text=True,
                                     env={**os.environ, **share}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) for i in range(3)]
            for run in runs:
                told = run.communicate()[0]
                self.assertEqual(run.returncode, 0, told)
                warned += told.count("not kept in the cache")
                restored += told.count(": restored")
            self.assertEqual({name: data for name, data in self.contents().items() if name in whole}, whole, f"seed {seed}")
            for file in self.cached():  # what has its name is whole
                if ".unfinished-" not in file:
                    self.assertEqual(self.bytes_of(file), kept[os.path.basename(file)], f"seed {seed}")
        self.assertGreater(warned, 0)
        self.assertGreater(restored, 0)


del Batch  # its tests run where it stands

if __name__ == "__main__":
    unittest.main()
