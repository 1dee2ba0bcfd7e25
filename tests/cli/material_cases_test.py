"""Maps of materials are taken for what they are: folders by every vendor's names, normals, heights, packed maps."""

import math
import os
import struct
import unittest
import zlib

from command import SOURCE, CommandCase, float_exr, noise_png
from png_image import read_png, write_png

CASES = os.path.join(SOURCE, "..", "shared", "cases")
SMALL = ["--tile-size", 16, "--effort", 0, "--mips", "box"]
SIDE = 32


def bump(x, y):
    return 1.2 * math.sin(0.5 * x) * math.cos(0.4 * y) + 0.5 * math.sin(0.3 * x + 0.35 * y)


def normal(x, y, green=1):
    east, south = bump(x + 0.5, y) - bump(x - 0.5, y), bump(x, y + 0.5) - bump(x, y - 0.5)
    length = math.sqrt(east * east + south * south + 1)
    return -east / length, green * south / length, 1 / length


def code(value):
    return max(0, min(255, int(value * 255 + 0.5)))


class MaterialCases(CommandCase):
    def picture(self, name, channels, value):
        """A PNG of SIDE x SIDE; value(x, y) gives the codes of a texel."""
        rows = [[v for x in range(SIDE) for v in value(x, y)] for y in range(SIDE)]
        write_png(self.path(name), rows, channels)
        return name

    def color(self, name="color.png"):
        return self.write(name, noise_png(SIDE, SIDE, 3, 8, 1))

    def grey(self, name, seed=2):
        return self.write(name, noise_png(SIDE, SIDE, 1, 8, seed))

    def normals(self, name, green=1, channels=3):
        return self.picture(name, channels, lambda x, y: [code(v * 0.5 + 0.5) for v in normal(x, y, green)][:channels])

    def bake(self, sample, *arguments, **options):
        """What is said on the way, and the maps of the pack by name."""
        done = self.run_tilepack("bake", sample, "-o", "pack", *SMALL, *arguments, **options)
        self.run_tilepack("validate", "pack")
        return done.stderr, {m["name"]: m for m in self.read_json("pack/pack.json")["maps"]}

    def case(self, name):
        path = os.path.join(CASES, name)
        if not os.path.exists(path):
            self.skipTest(name + " is not there")
        return path

    def texels(self, name):
        """The texels of a PNG, row by row, as lists of codes."""
        rows, channels, _ = read_png(self.path(name))
        return [row[at:at + channels] for row in rows for at in range(0, len(row), channels)]

    def tilts(self, name="normal"):
        """The mean of |x| + |y| of the vectors of each level."""
        figures = []
        for level in self.read_json("pack/pack.json")["maps"][1]["levels"]:
            texels = self.texels("pack/" + level["file"])
            figures.append(sum(abs(t[0] / 127.5 - 1) + abs(t[1] / 127.5 - 1) for t in texels) / len(texels))
        return figures

    # Folders of maps.

    def test_folders_of_vendors_are_taken_whole(self):
        for folder, maps in {
                "mat_freepbr": ["color", "normal", "roughness"],
                "mat_substance": ["color", "normal", "roughness", "ao"],
                "mat_gltf": ["color", "normal", "emissive", "orm"],
                "mat_spaces": ["color", "normal"],
                "mat_case": ["color", "normal"],
                "mat_appledouble": ["color", "normal"],
        }.items():
            with self.subTest(folder):
                said, found = self.bake(self.case(folder))
                self.assertEqual(sorted(found), sorted(maps))
                if folder == "mat_substance":
                    self.assertIn("Wall_Normal.png is passed over: Wall_Normal_OpenGL.png is the normal map; to take it:",
                                  said)
                    self.assertEqual(found["normal"]["normal_y"], "up")

    def test_maps_of_other_formats_belong_to_the_set(self):
        said, found = self.bake(self.case("mat_partial"))
        self.assertEqual(sorted(found), ["color", "normal", "roughness"])

    def test_dot_files_and_capitals(self):
        os.mkdir(self.path("m"))
        self.color("m/Rock_albedo.png")
        self.normals("m/rock_normal.png")
        self.write("m/._rock_albedo.png", b"\0\5\x16\7")
        said, found = self.bake("m")
        self.assertEqual(list(found), ["color", "normal"])
        self.assertNotIn("._", said)

    def test_what_is_passed_over_is_named_and_can_be_taken(self):
        os.mkdir(self.path("m"))
        self.color("m/rock_albedo.png")
        self.grey("m/rock_cavity.png")
        self.grey("m/rock_bump.png", 3)
        self.grey("m/rock_displacement.png", 4)
        self.write("m/rock_opacity.xcf", b"gimp")
        said, found = self.bake("m")
        self.assertEqual(list(found), ["color", "height"])
        for text in ["m/rock_cavity.png is passed over: no kind of map is called 'cavity'",
                     "--map cavity:data=m/rock_cavity.png", "--map height=m/rock_bump.png",
                     "m/rock_opacity.xcf is passed over: its format is not read"]:
            self.assertIn(text, said)
        said, found = self.bake("m", "--map", "cavity:data=m/rock_cavity.png", "--map", "height=m/rock_bump.png")
        self.assertEqual(sorted(found), ["cavity", "color", "height"])
        self.assertNotIn("cavity.png is passed over", said)
        self.assertNotIn("bump.png is passed over", said)
        self.color("m/other.png")
        self.bake("m", "--map", "color=m/other.png") # in the place of the one that was found: the main map
        self.assertEqual(self.read_json("pack/pack.json")["maps"][0]["name"], "color")

    def test_odd_names(self):
        rough = ["color", "roughness"]
        for names, prefix, maps in [
                (["rockalbedo", "rockroughness"], "", rough), (["Albedo_Rock", "Roughness_Rock"], "", rough),
                (["rock", "rock_rough"], "", rough), (["rock", "rock_rough"], "/ROCK", rough),
                (["rock_albedo", "rock_albedo (1)", "rock_albedo copy", "rock_rough"], "", rough),
                (["rock_albedo_1k", "rock_albedo_2k", "rock_rough_1k", "rock_rough_2k"], "/rock_1k", rough),
                (["rock_albedo.1001", "rock_rough.1001", "rock_albedo.1002"], "/rock_1001", rough),
                (["rock_albedo_v1", "rock_albedo_v2", "rock_rough_v2"], "", rough),
                (["rock_BaseColor_sRGB", "rock_Roughness_raw"], "", rough),
                (["Rock [2K] Base Color", "Rock [2K] Roughness"], "", rough), (["rock_d", "rock_r"], "", rough),
                (["metal_albedo", "metal_roughness"], "", rough), (["Fels_H\u00f6he_albedo", "fels_H\u00f6he_rough"], "", rough),
                (["ROCK_BASECOLOR", "rock_Roughness"], "", rough)]:
            with self.subTest(names[0]):
                folder = "odd%d" % len(os.listdir(self.folder))
                os.mkdir(self.path(folder))
                for name in names:
                    is_rough = "ough" in name or name.endswith("_r")
                    (self.grey if is_rough else self.color)(f"{folder}/{name}.png")
                self.assertEqual(sorted(self.bake(folder + prefix)[1]), maps)
        os.makedirs(self.path("up/2K"))
        self.color("up/2K/rock_albedo.png")
        self.refused("bake", "up", "-o", "other", code=3, saying="2K")
        os.mkdir(self.path("up/2K/rock_normal.png"))
        self.assertEqual(list(self.bake("up/2K")[1]), ["color"])

    def test_quiet_says_nothing_of_it(self):
        os.mkdir(self.path("m"))
        self.color("m/rock_albedo.png")
        self.grey("m/rock_cavity.png")
        self.assertEqual(self.bake("m", "--quiet")[0], "")

    def test_a_folder_without_a_color_map_says_what_was_seen(self):
        os.mkdir(self.path("m"))
        self.grey("m/a_rough.png")
        self.color("m/photo.png")
        self.refused("bake", "m", "-o", "pack", code=3, saying=["a_rough.png, photo.png", "--list-maps", "_albedo"])

    # Roles.

    def test_roles_have_their_encodings(self):
        self.color()
        maps = ["ao", "metallic", "emissive", "opacity"]
        files = {m: self.grey(m + "_x.png") if m != "emissive" else self.color("glow_x.png") for m in maps}
        said, found = self.bake("color.png", *[a for m in maps for a in ("--map", f"{m}={files[m]}")])
        self.assertEqual([found[m]["role"] for m in maps], maps)
        self.assertEqual([found[m]["encoding"] for m in maps], ["linear", "linear", "srgb", "linear"])

    def test_wrong_maps_are_told_apart(self):
        self.color()
        for given, saying in {
                ":data=color.png": "the name before ':' is empty",
                "color.png=normal": "--map normal=color.png",
                "normal": "has no '='",
                "rougness=color.png": "did you mean 'roughness'?",
                "dirt=color.png": ["orm", "emissive", "dirt:data=FILE"],
                "ao=": "ROLE=FILE",
        }.items():
            with self.subTest(given):
                self.refused("bake", "color.png", "-o", "pack", "--map", given, code=1, saying=saying)

    def test_packed_maps_say_their_channels(self):
        self.color()
        self.normals("n.png")
        for role, contents in {
                "orm": ["ao", "roughness", "metallic"],
                "arm": ["ao", "roughness", "metallic"],
                "rma": ["roughness", "metallic", "ao"],
                "mrao": ["metallic", "roughness", "ao"]
        }.items():
            flat = {"ao": 200, "roughness": 60, "metallic": 10}
            self.picture("packed.png", 3, lambda x, y: [flat[c] for c in contents])
            _, found = self.bake("color.png", "--map", "normal=n.png", "--map", role + "=packed.png")
            self.assertEqual(found[role]["contents"], contents)
            self.assertEqual(found[role]["role"], "data")
            last = self.texels("pack/" + found[role]["levels"][-1]["file"])[0]
            for content, value in zip(contents, last):
                if content == "roughness":
                    self.assertGreater(value, 90, "roughness takes up the spread of normals")
                else:
                    self.assertEqual(value, flat[content])

    def test_help_readme_and_table_are_one(self):
        listed = self.run_tilepack("bake", "--list-maps").stdout
        with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as stream:
            readme = stream.read()
        names = [line for line in listed.splitlines() if line and not line.startswith(" ")]
        self.assertIn("mrao", names)
        help_text = " ".join(self.run_tilepack("bake", "--help").stdout.split())
        for name in names:
            self.assertIn(name, help_text)
            self.assertIn(f"`{name}`", readme)
        words = {word for line in readme.splitlines() if line.startswith("| `") for word in line.split() if word.startswith("_")}
        self.assertEqual(words, {word for word in listed.split() if word.startswith("_")})
        self.assertLessEqual(words, set(help_text.split()))

    # Normals.

    def test_two_channels_are_averaged_as_three(self):
        self.color()
        self.bake("color.png", "--map", "normal=" + self.normals("n3.png"))
        right = self.tilts()
        said, found = self.bake("color.png", "--map", "normal=" + self.normals("n2.png", channels=2))
        self.assertIn("z is worked out", said)
        self.assertEqual(found["normal"]["channels"], 3)
        for a, b in zip(right, self.tilts()):
            self.assertAlmostEqual(a, b, delta=0.02)

    def test_normals_of_the_cases(self):
        color = self.case("color.png")
        self.bake(color, "--map", "normal=" + self.case("normal_xyz.png"))
        right = self.tilts()
        for name in ["normal_xy.png", "normal_signed.exr"]:
            self.bake(color, "--map", "normal=" + self.case(name), "--image-format", "png", "--depth", "u8")
            for a, b in zip(right, self.tilts()):
                # Rounded otherwise, normals may lead to another patch. Averaged without z, they are .14 lower at level 3.
                self.assertAlmostEqual(a, b, delta=0.04)

    def test_green_is_found_turned_and_kept(self):
        self.color()
        self.picture("h.png", 1, lambda x, y: [code(bump(x, y) / 4 + 0.5)])
        self.normals("up.png")
        self.normals("down.png", green=-1)
        for maps in [["--map", "height=h.png"], []]:
            for name in ["up", "down"]:
                said, found = self.bake("color.png", "--map", f"normal={name}.png", *maps)
                self.assertEqual(found["normal"]["normal_y"], name)
                self.assertEqual("--normal-y up" in said, name == "down")
                before = self.texels("pack/normal_0.png")
                said, found = self.bake("color.png", "--map", f"normal={name}.png", *maps, "--normal-y", "up")
                self.assertEqual(found["normal"]["normal_y"], "up")
                turned = [[r, g if name == "up" else 255 - g, b] for r, g, b in before]
                self.assertEqual(self.texels("pack/normal_0.png"), turned)
        said, found = self.bake("color.png", "--map", "normal-dx=up.png")
        self.assertIn("by its name", said)
        self.assertEqual(found["normal"]["normal_y"], "down")
        self.refused("bake", "color.png", "-o", "other", "--normal-y", "left", code=1, saying="up|down|auto")

    def test_leaning_normals_are_told(self):
        self.color()
        self.picture("lean.png", 3, lambda x, y: [150 + x % 3, 128, 250])
        said, _ = self.bake("color.png", "--map", "normal=lean.png")
        self.assertIn("lean by", said)

    # Heights.

    def test_metres_come_back_or_are_refused(self):
        self.color()
        self.write("m.exr", float_exr(SIDE, SIDE, lambda x, y: 250 + 40 * bump(x, y)))
        message = self.refused("bake", "color.png", "-o", "pack", "--map", "height=m.exr", "--format", "png", *SMALL,
                               code=3, saying=["--height-range auto", "--format exr", "texels would be clipped"])
        given = message.split("--height-range ")[2].split(")")[0]
        for wanted in ["auto", given, "100,400"]:
            _, found = self.bake("color.png", "--map", "height=m.exr", "--format", "png", "--height-range", wanted)
            low, high = found["height"]["range"]
            self.assertEqual(found["height"]["depth"], "u16")
            values = [t[0] for t in self.texels("pack/height_0.png")]
            metres = [low + v / 65535 * (high - low) for v in values]
            self.assertGreaterEqual(min(metres), 250 - 40 * 1.71)
            self.assertLessEqual(max(metres), 250 + 40 * 1.71)
            self.assertGreater(max(metres) - min(metres), 60)
            inspected = self.run_tilepack("inspect", "pack", "--format", "json").stdout
            self.assertIn('"range"', inspected)
        self.refused("bake", "color.png", "-o", "other", "--map", "height=m.exr", "--height-range", "0,200", *SMALL,
                     code=3, saying=["outside", "--height-range auto"])
        for wrong in ["5", "5,5", "9,1", "a,b", "1,2,3", "nan,1", "0,inf"]:
            self.refused("bake", "color.png", "-o", "other", "--map", "height=m.exr", f"--height-range={wrong}", *SMALL,
                         code=1, saying="A,B")

    def test_heights_of_the_case(self):
        self.refused("bake", self.case("color.png"), "-o", "pack", "--map", "height=" + self.case("height_metres.exr"),
                     "--format", "png", *SMALL, code=3, saying=["--height-range auto"])

    # Fireflies, and notes of every verb that reads samples.

    def test_fireflies_are_named_and_placed(self):
        bake = ["bake", self.case("firefly_80.exr"), "-o", "pack", "--tile-size", 32, "--mips", "none", "--effort", 0]
        self.assertIn("(fireflies)", self.run_tilepack(*bake).stdout)
        done = self.run_tilepack(*bake, "--report", "page.html", "--report-format", "json")
        self.assertIn('"fireflies"', done.stdout)
        with open(self.path("page.html"), encoding="utf-8") as stream:
            self.assertIn("(fireflies)", stream.read())

    def test_every_verb_that_reads_samples_tells_its_notes(self):
        doubtful = self.picture("g.png", 3, lambda x, y: [x * 7 % 256, y * 5 % 256, 90])
        with open(self.path(doubtful), "rb") as stream:
            data = stream.read()
        chunk = b"gAMA" + struct.pack(">I", 100000)
        chunk = struct.pack(">I", 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
        self.write("g.png", data[:33] + chunk + data[33:])
        self.write_json("one.json", [{"north": 0, "east": 0, "south": 0, "west": 0}])
        for command in [["bake", "g.png", "-o", "pack", *SMALL], ["compare", "g.png", "g.png"],
                        ["layouts", "--tiles", 5, "--tile-size", 16, "--sample", "g.png"],
                        ["pack", "g.png", "-o", "tiles", "--colors", "one.json"]]:
            with self.subTest(command[0]):
                self.assertIn("gAMA", self.run_tilepack(*command).stderr)
                self.assertNotIn("gAMA", self.run_tilepack(*command, "--encoding", "srgb").stderr)


if __name__ == "__main__":
    unittest.main()
