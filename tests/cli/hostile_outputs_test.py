"""Output folders that can't or must not be written: refused, older packs and other files intact."""

import os
import resource
import shutil
import subprocess
import tempfile
import unittest

from command import TILEPACK, CommandCase

SMALL = ("--tile-size", 16, "--effort", 0, "--virtual-size", 8)
USAGE, CANNOT_WRITE = 1, 4


def almost_full():
    """A limit on the size of files stands for a full disk: writing fails in the middle of one."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))


class Outputs(CommandCase):
    def test_files_of_others(self):
        sample = self.noise_png("sample.png")
        os.mkdir(self.path("out"))
        self.write("out/thesis.txt", "years of work")
        self.refused("bake", sample, "-o", "out", *SMALL, code=CANNOT_WRITE, saying="thesis.txt")
        self.refused("bake", sample, "-o", ".", *SMALL, code=CANNOT_WRITE)
        self.write("out/pack.json", '{"name": "something else"}')
        self.refused("bake", sample, "-o", "out", *SMALL, code=CANNOT_WRITE, saying="no readable tile pack")

    def test_files_of_others_in_the_way_of_a_pack(self):
        self.older_pack()
        self.write("out/notes.txt", "mine")
        self.write("out/color_5.png", "mine too")  # the older pack has five levels, tiles of 32 have six
        self.refused("bake", "sample.png", "-o", "out", *SMALL, "--tile-size", 32, code=CANNOT_WRITE,
                     saying=("out/color_5.png", "in the way"))
        self.run_tilepack("bake", "sample.png", "-o", "out", *SMALL, "--seed", 2)
        with open(self.path("out/notes.txt"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "mine")

    def test_the_folder_is_a_file(self):
        sample = self.noise_png("sample.png")
        self.refused("bake", sample, "-o", "./sample.png", *SMALL, code=USAGE, saying="would replace a file that is worked from")
        self.refused("bake", sample, "-o", self.write("notes.txt", "mine"), *SMALL, code=CANNOT_WRITE, saying="no folder")
        self.refused("bake", sample, "-o", "sample.png/out", *SMALL, code=CANNOT_WRITE)
        self.refused("bake", sample, "-o", "/proc/out", *SMALL, code=CANNOT_WRITE)

    def test_a_depfile_that_cannot_be_written(self):
        sample = self.noise_png("sample.png")
        self.refused("bake", sample, "-o", "out", *SMALL, "--depfile", "/proc/nowhere/out.d", code=CANNOT_WRITE,
                     saying="nowhere/out.d")
        self.refused("bake", "missing.png", "-o", "out", *SMALL, "--depfile", "out.d", code=2)

    def test_a_link_to_nothing(self):
        os.symlink("nowhere", self.path("out"))
        done = self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL, code=CANNOT_WRITE)
        self.assertIn("link to nothing", done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), ["out", "sample.png"])

    def test_links_in_place_of_outputs(self):
        """As the README says: a pack goes where the link leads, a file takes its place."""
        os.makedirs(self.path("elsewhere"))
        self.write("kept.png", "mine")
        os.symlink("elsewhere", self.path("out"))
        os.symlink("kept.png", self.path("picture.png"))
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL)
        self.run_tilepack("render", "out", "-o", "picture.png", "--rect", "0,0,8,8")
        self.assertTrue(os.path.islink(self.path("out")))
        self.assertTrue(os.path.isfile(self.path("elsewhere/pack.json")))
        self.assertFalse(os.path.islink(self.path("picture.png")))
        with open(self.path("kept.png"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "mine")

    def test_what_is_read_is_not_replaced(self):
        self.older_pack()
        self.noise_png("other.png", seed=2)
        self.write("mine.json", '{"purpose": "p", "cost": "c", "effort": 0}')
        self.write("wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
        os.symlink("sample.png", self.path("link.png"))
        bake = ("bake", "sample.png", "-o", "new", *SMALL)
        again = ("bake", "sample.png", "-o", "out", *SMALL)
        for arguments in ((*bake, "--depfile", "sample.png"),
                          (*bake, "--depfile", "./new/../sample.png"),
                          (*bake, "--depfile", "link.png"),
                          (*bake, "--map", "height=other.png", "--depfile", "other.png"),
                          (*bake, "--preset", "mine.json", "--depfile", "mine.json"),
                          (*again, "--depfile", "out/color_1.png"),
                          (*again, "--depfile", "out/pack.json"),
                          ("bake", "out/color_0.png", "-o", "out", *SMALL),
                          ("pack", "out/color_0.png", "-o", "out", "--colors", "colors.json"),
                          ("render", "out", "-o", "out/color_1.png"),
                          ("render", "out/pack.json", "-o", self.path("out", "color_1.png")),
                          ("inspect", "out", "--picture", "out/color_0.png"),
                          ("inspect", "out", "--preview", "out/color_0.png"),
                          ("inspect", "out", "--mapping", "--picture", "out/color_0.png"),
                          ("compare", "sample.png", "other.png", "--picture", "other.png")):
            with self.subTest(arguments):
                self.refused(*arguments, code=USAGE, saying="would replace")

    def test_outputs_do_not_replace_one_another(self):
        self.older_pack()
        self.refused("bake", "sample.png", "-o", "new", *SMALL, "--depfile", "x.html", "--report", "./x.html",
                     code=USAGE, saying=("--report", "--depfile"))
        self.refused("inspect", "out", "--picture", "x.png", "--preview", "x.png", code=USAGE,
                     saying=("--picture", "--preview"))

    def test_pages_are_html(self):
        self.older_pack()
        for arguments in (("bake", "sample.png", "-o", "out", *SMALL, "--report", "sample.png"),
                          ("bake", "sample.png", "-o", "out", *SMALL, "--report", "out/pack.json"),
                          ("bench", "out", "--quick", "--report", "out/pack.json"),
                          ("bench", "--spans", "--quick", "--report", "sample.png")):
            with self.subTest(arguments):
                self.refused(*arguments, code=USAGE, saying=("--report", ".html"))

    def test_what_is_wrong_with_the_name_of_a_page_or_picture(self):
        self.older_pack()
        os.mkdir(self.path("pages.html"))
        for arguments, option, allowed in (
                (("bake", "sample.png", "-o", "new", "--report"), "--report", ".html"),
                (("bench", "out", "--quick", "--report"), "--report", ".html"),
                (("render", "out", "-o"), "--output", ".png or .exr"),
                (("inspect", "out", "--preview"), "--preview", ".png or .svg")):
            for name, fault in ((".", "is a folder; name a file in it that ends in "), ("new/", "is a folder"),
                                ("page", "has no ending; it must be "), ("page.txt", "ends in '.txt'; it must be ")):
                with self.subTest(arguments, name=name):
                    message = self.refused(*arguments, name, code=USAGE, saying=(f"{option}: '{name}' {fault}"))
                    self.assertTrue(message.endswith(allowed + "\n"), message)
        self.refused("bake", "sample.png", "-o", "new", "--report", "pages.html", code=USAGE, saying="is a folder")

    def test_a_pack_in_a_pack(self):
        self.older_pack()
        for folder in ("out/sub", "out/sub/", "out/deep/er", "./new/../out/sub"):
            with self.subTest(folder):
                for arguments in (("bake", "sample.png", *SMALL), ("pack", "sample.png", "--colors", "none.json")):
                    self.refused(*arguments, "-o", folder, code=USAGE,
                                 saying=(f"--output: '{folder}' lies in the pack 'out'", "outside of it"))
        for folder in ("out", "out/", "outer"):
            self.run_tilepack("bake", "sample.png", "-o", folder, *SMALL)
        self.write("pack.json", "{}")  # of something else
        self.run_tilepack("bake", "sample.png", "-o", "other", *SMALL)

    def older_pack(self):
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", *SMALL)

    def test_a_full_disk(self):
        self.older_pack()
        sample = self.noise_png("large.png", 256, 256)
        for output in ("out", "new", "new/deep"):
            with self.subTest(output):
                self.refused("bake", sample, "-o", output, "--effort", 0, "--tile-size", 64, code=CANNOT_WRITE,
                             saying=output, preexec_fn=almost_full)
        os.mkdir(self.path("deep" * 60))
        os.mkdir(self.path("deep" * 60, "deep" * 60))
        names = os.path.join("deep" * 60, "deep" * 60)  # so long that the rule fills the disk
        for name in ("a", "b", "c", "d", "e", "f", "g", "h"):
            shutil.copy(self.path("sample.png"), self.path(names, name + ".png"))
        maps = [part for name in "abcdefgh" for part in ("--map", f"{name}:data={names}/{name}.png")]
        self.refused("bake", "sample.png", "-o", "out", *SMALL, *maps, "--depfile", "out.d", code=CANNOT_WRITE,
                     saying="out.d: writing failed", preexec_fn=almost_full)

    def test_a_pack_is_whole_where_its_report_cannot_be_printed(self):
        self.noise_png("good.png", 48, 48)
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([TILEPACK, "bake", "good.png", "-o", "p", "--tile-size", "16", "--effort", "0"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("p is whole and in place", done.stderr)
        self.run_tilepack("validate", "p")

    def test_a_full_disk_for_pictures(self):
        self.run_tilepack("bake", self.noise_png("sample.png"), "-o", "out", "--effort", 0, "--tile-size", 32,
                          "--virtual-size", 64, "--mapping", "index")
        for arguments in (("inspect", "out", "--picture", "x.svg"),
                          ("inspect", "out", "--picture", "x.png"),
                          ("inspect", "out", "--index-map", "x.json"),
                          ("render", "out", "-o", "x.png"),
                          ("render", "out", "-o", "x.exr"),
                          ("compare", "out/color_0.png", "sample.png", "--picture", "x.png")):
            if arguments[0] == "compare":
                self.noise_png("sample.png", 128, 128)
            with self.subTest(arguments):
                self.refused(*arguments, code=CANNOT_WRITE, saying="writing failed", preexec_fn=almost_full)
                self.write(arguments[-1], "older")
                self.refused(*arguments, code=CANNOT_WRITE, preexec_fn=almost_full)
                os.remove(self.path(arguments[-1]))

    def test_a_read_only_folder(self):
        self.older_pack()
        os.mkdir(self.path("empty"))
        drop = None
        if os.geteuid() == 0:  # to whom nothing is read-only
            def drop():
                os.setgid(65534)
                os.setuid(65534)
            os.chmod(self.folder, 0o755)
            # Where the build lies, another user may not be able to look.
            elsewhere = tempfile.TemporaryDirectory()
            self.addCleanup(elsewhere.cleanup)
            os.chmod(elsewhere.name, 0o755)
            self.program = shutil.copy(TILEPACK, elsewhere.name)
        for name in ("out", "empty", "."):
            os.chmod(self.path(name), 0o555)
        for output in ("out", "empty", "new"):
            with self.subTest(output):
                self.refused("bake", "sample.png", "-o", output, *SMALL, code=CANNOT_WRITE, saying=output,
                             preexec_fn=drop)
        # Parent and owner would let the folder be replaced as a whole, which is not what 0o555 says.
        os.chmod(self.path("."), 0o777)
        if drop:
            for folder, _, files in os.walk(self.folder):
                for name in (folder, *(os.path.join(folder, file) for file in files)):
                    os.chown(name, 65534, 65534)
        for output in ("out", "empty"):
            with self.subTest(output, parent="writable"):
                self.refused("bake", "sample.png", "-o", output, *SMALL, code=CANNOT_WRITE, saying=output,
                             preexec_fn=drop)
        for name in ("out", "empty", "."):
            os.chmod(self.path(name), 0o755)


if __name__ == "__main__":
    unittest.main()
