"""The rules of this repository that a program can check."""

import os
import re
import subprocess
import unittest

SOURCE = os.environ["TILEPACK_SOURCE"]
TILEPACK = os.environ["TILEPACK"]

# From low to high: a room of lib/tilepack/ includes only itself and those before it.
ROOMS = ("error numeric json image tileset exemplar match seam synth transition layout mip mapping pack lookup sampler scanline pattern shader "
         "bake scene batch check measure bench report").split()
CODE = (".h", ".cpp", ".cpp.in", ".py", ".sh")


def files(*endings, below=""):
    """(path from the source, text) of every file of ours whose name ends so."""
    found = []
    for folder, folders, names in os.walk(os.path.join(SOURCE, below)):
        folders[:] = sorted(f for f in folders if f != "build" and (not f.startswith(".") or f == ".ci"))
        for name in sorted(names):
            if name.endswith(endings):
                path = os.path.join(folder, name)
                with open(path, encoding="utf-8") as stream:
                    found.append((os.path.relpath(path, SOURCE), stream.read()))
    return found


def house(heading):
    """A section of lib/README.md, the map of the house."""
    with open(os.path.join(SOURCE, "lib/README.md"), encoding="utf-8") as stream:
        return re.search(rf"^## {heading}.*?\n(.*?)(?=^## |\Z)", stream.read(), re.MULTILINE | re.DOTALL).group(1)


class Rules(unittest.TestCase):
    def none_of(self, faults, rule):
        self.assertEqual(faults, [], rule)

    def test_rooms_include_only_lower_ones(self):
        faults = []
        self.assertGreater(len(files(".h", below="lib/tilepack")), 30)
        for path, text in files(".h", ".cpp", ".cpp.in", below="lib/tilepack"):
            folder = path.split(os.sep)[2]
            self.assertIn(folder, ROOMS, path)
            for included in re.findall(r'#\s*include\s+"([^"]*)"', text):
                parts = included.split("/")
                if parts[0] != "tilepack" or len(parts) != 3:
                    faults.append(f'{path}: "{included}" is not "tilepack/FOLDER/FILE.h"')
                elif ROOMS.index(parts[1]) > ROOMS.index(folder):
                    faults.append(f"{path}: includes {included}, which is above it")
        self.none_of(faults, "the order of rooms is " + " ".join(ROOMS))

    def test_every_room_is_told_of(self):
        told = [re.match(r"\| `([a-z]+)` \| \S", line) for line in house("The rooms").splitlines()]
        self.assertEqual([m.group(1) for m in told if m], ROOMS, "lib/README.md has a line a room, low to high")
        found = {path.split(os.sep)[2] for path, _ in files(".h", below="lib/tilepack")}
        self.none_of(sorted(found - set(ROOMS)), "every folder of lib/tilepack is a room")

    def test_what_the_map_of_the_house_points_at_is_there(self):
        pages = {path.split(os.sep, 2)[2]: text for path, text in files(".h", ".cpp", ".md", below="lib/tilepack")}
        faults, told = [], 0
        for line in house("Where is").splitlines():
            cells = line.split("|")[1:-1]
            if len(cells) != 3 or "`" not in cells[1] or cells[0].strip() == "…":
                continue
            told += 1
            named = re.findall(r"`([^`]+/[^`]+)`", cells[1])
            faults += [f"no {file}" for file in named if file not in pages]
            text = "".join(pages.get(file, "") for file in named)
            faults += [f"no {word} in {' '.join(named)}" for word in re.findall(r"`(\w+)`", cells[2]) if word not in text]
        self.assertGreater(told, 30)
        self.none_of(faults, "lib/README.md: whoever looks for something finds it")

    def test_one_word_for_one_idea(self):
        never = []
        for line in house("Words").splitlines():
            cells = line.split("|")[1:-1]
            if len(cells) == 3 and cells[0].strip() not in ("word", "---"):
                never += [word.strip() for word in cells[2].split(",") if word.strip()]
        self.assertGreater(len(never), 15)
        pattern = re.compile(r"\b(" + "|".join(map(re.escape, never)) + r")s?\b", re.IGNORECASE)
        faults = []
        for below in ("lib", "cli"):
            for path, text in files(".h", ".cpp", ".cpp.in", ".md", below=below):
                if path not in (os.path.join("lib", "README.md"), os.path.join("lib", "REFERENCES.md")):  # titles are as they are
                    faults += [f"{path}: {m.group()}" for m in pattern.finditer(text)]
        self.none_of(faults, "lib/README.md has the word to use instead")

    def test_headers_say_what_they_are(self):
        faults = [path for path, text in files(".h", below="lib") + files(".h", below="cli") + files(".h", below="tests/support")
                  if "///" not in text]
        self.none_of(faults, "a header's comment, after ///, is its documentation")

    def test_tests_mirror_the_rooms(self):
        beside = {"cli", "repo", "install", "quality", "support", "fuzz"}
        found = {path.split(os.sep)[1] for path, _ in files(".cpp", ".h", ".py", ".cmake", below="tests") if path.count(os.sep) > 1}
        self.none_of(sorted(found - beside - set(ROOMS)), "tests/ROOM tests lib/tilepack/ROOM")

    def test_no_headers_include_each_other_in_a_circle(self):
        includes = {}
        for path, text in files(".h", ".cpp", below="lib/tilepack"):
            pair = re.sub(r"\.(h|cpp)$", "", path.split(os.sep, 2)[2])
            found = set(re.findall(r'#\s*include\s+"tilepack/([^"]*)\.h"', text))
            includes.setdefault(pair, set()).update(found - {pair})
        self.assertGreater(len(includes), 100)
        done, faults = set(), []

        def visit(pair, way):
            if pair in way:
                faults.append(" -> ".join([*way[way.index(pair):], pair]))
            elif pair not in done:
                for lower in sorted(includes.get(pair, ())):
                    visit(lower, [*way, pair])
                done.add(pair)

        for pair in sorted(includes):
            visit(pair, [])
        self.none_of(faults, "a header and its source are one; no such pairs include each other, directly or through others")

    def test_type_names_are_unique(self):
        homes, faults = {}, []
        for path, text in files(".h", below="lib/tilepack"):
            for name in re.findall(r"^(?:struct|class|enum class)\s+(\w+)[^;{]*\{", text, re.MULTILINE):
                homes.setdefault(name, set()).add(path)
        self.assertGreater(len(homes), 100)
        faults = [f"{name}: {', '.join(sorted(paths))}" for name, paths in homes.items() if len(paths) > 1]
        self.none_of(faults, "a name stands for one type (two would break the one-definition rule)")

    def test_the_top_level_holds_the_few_folders_it_should(self):
        allowed = {"cli", "lib", "presets", "tests", "samples", "build", "out"}
        found = {name for name in os.listdir(SOURCE) if os.path.isdir(os.path.join(SOURCE, name)) and not name.startswith(".")}
        self.none_of(sorted(found - allowed), "the top level holds " + " ".join(sorted(allowed)))

    def test_the_library_knows_nothing_of_the_command_line(self):
        faults = [path for path, text in files(".h", ".cpp", below="lib")
                  if re.search(r"#\s*include\s+[<\"](CLI/|.*cli/|iostream>)", text)
                  or re.search(r"\bstd::(cout|cerr|clog)\b|\b(printf|puts)\(|\bexit\(", text)]
        self.none_of(faults, "lib/ prints nothing and parses no command line")

    def test_the_library_names_no_option(self):
        # It names fields (error/field.h), which whoever shows the message spells: --layout, "layout", layout.
        literal = re.compile(r'"(?:[^"\\\n]|\\.)*"')
        faults = []
        for path, text in files(".h", ".cpp", ".cpp.in", below="lib"):
            for number, line in enumerate(text.splitlines(), 1):
                if re.match(r"\s*//", line) or line.lstrip().startswith("#include"):
                    continue
                faults += [f"{path}:{number}: {found}" for found in literal.findall(line)
                           if re.search(r"(?<![\w<!-])--[a-z]", found)]
        self.none_of(faults, "no option of the command line in a text of lib/: write field(\"name\")")

    def test_json_and_image_libraries_stay_out_of_headers(self):
        # ..-inl.h files are parts of a .cpp, compiled once for each instruction set.
        faults = [path for path, text in files(".h", below="lib") if not path.endswith("-inl.h")
                  and re.search(r"#\s*include\s+<(nlohmann|OpenImageIO|opencv2|fmt|hwy|xxhash)", text)]
        self.none_of(faults, "whoever uses the library needs none of the libraries it is made with")

    def test_cited_works_are_listed(self):
        with open(os.path.join(SOURCE, "lib/REFERENCES.md"), encoding="utf-8") as stream:
            listed = set(re.findall(r"^\| ([A-Za-z]+[0-9]*) \|", stream.read(), re.MULTILINE))
        self.assertIn("Wei04", listed)
        faults, used = [], set()
        for path, text in files(".h", ".cpp", ".md", below="lib"):
            comments = text if path.endswith(".md") else "\n".join(re.findall(r"//.*", text))
            for key in re.findall(r"\[([A-Z][A-Za-z]+[0-9]*)(?:,[^\]]*| §[^\]]*)?\]", comments):
                used.add(key)
                if key not in listed and re.search(r"[0-9]$", key):
                    faults.append(f"{path}: [{key}]")
        self.none_of(faults, "every key stands in lib/REFERENCES.md")
        self.assertLessEqual({"Wei04", "Cohen03"}, used)

    def test_headings_of_pages_are_headings(self):
        faults = []
        for path, text in files(".md"):
            fenced = False
            for number, line in enumerate(text.splitlines(), 1):
                fenced ^= line.startswith("```")
                if not fenced and re.match(r" {0,3}#+[^#\s]", line):
                    faults.append(f"{path}:{number}: {line[:40]}")
        self.none_of(faults, "a page's heading has a space after its signs (was it formatted as code?)")

    def test_files_are_short(self):
        faults = [f"{path}: {count} lines" for path, text in files(*CODE, "CMakeLists.txt", ".json", ".md")
                  if (count := text.count("\n")) > 500]
        self.none_of(faults, "no file has more than 500 lines")

    def test_names_say_what_is_inside(self):
        faults = []
        for path, _ in files(*CODE):
            for part in path.split(os.sep):
                if re.match(r"(utils?|common|misc|helpers?|stuff|manager)\b", part.rsplit(".", 1)[0].lower()):
                    faults.append(path)
                elif not re.fullmatch(r"[a-z0-9_.-]+|CMakeLists\.txt|README\.md", part) and part not in ("main",):
                    faults.append(path)
        self.none_of(faults, "no catch-all names; lower case with underscores")

    def test_nothing_is_left_to_do(self):
        words = re.compile(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b")
        faults = [f"{path}: {m.group()}" for path, text in files(*CODE, "CMakeLists.txt") for m in words.finditer(text)]
        self.none_of(faults, "what is unfinished does not land")

    def test_headers_are_read_once_and_in_the_namespace(self):
        faults = [path for path, text in files(".h", below="lib") if not path.endswith("-inl.h")
                  and (text.count("#pragma once") != 1 or "namespace tilepack" not in text)]
        self.none_of(faults, "#pragma once, namespace tilepack")

    def test_nothing_reads_the_clock_or_the_libraries_random_numbers(self):
        pattern = re.compile(r"std::(mt19937|random_device|rand\b)|\brand\(\)|system_clock|\btime\(nullptr\)|unordered_")
        faults = [f"{path}: {m.group()}" for path, text in files(".h", ".cpp", below="lib")
                  for m in pattern.finditer("\n".join(line.split("//")[0] for line in text.splitlines()))]
        self.none_of(faults, "the same input makes the same bytes")


class Readme(unittest.TestCase):
    def setUp(self):
        with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as stream:
            self.readme = stream.read()
        listing = self.tilepack("help")
        self.verbs = re.findall(r"^  ([a-z]+) ", listing.split("Verbs:")[1].split("\n\n")[0], re.MULTILINE)
        self.assertIn("bake", self.verbs)

    def tilepack(self, *arguments):
        return subprocess.run([TILEPACK, *arguments], capture_output=True, text=True, check=True).stdout

    def examples(self):
        """Command lines of the README's blocks of code, continued lines joined."""
        blocks = re.findall(r"^```(?:sh|bash|console)?\n(.*?)^```", self.readme, re.MULTILINE | re.DOTALL)
        lines = "\n".join(blocks).replace("\\\n", " ").splitlines()
        return [line.split("#")[0].strip() for line in lines if re.match(r"\s*(\$ )?tilepack ", line)]

    def test_every_verb_has_an_example(self):
        shown = {line.replace("$ ", "").split()[1] for line in self.examples()}
        missing = [v for v in self.verbs if v != "help" and v not in shown]
        self.assertEqual(missing, [], "the README shows every verb")

    def test_examples_use_verbs_and_options_that_exist(self):
        for line in self.examples():
            words = line.replace("$ ", "").split()
            if words[1].startswith("-"):
                continue
            with self.subTest(line):
                self.assertIn(words[1], self.verbs)
                manual = self.tilepack("help", words[1]) if words[1] != "help" else "--help"
                for option in words[2:]:
                    if option.startswith("--"):
                        self.assertRegex(manual, re.escape(option.split("=")[0]) + r"\b")

    def test_every_verb_explains_itself_with_an_example(self):
        for verb in self.verbs:
            if verb == "help":
                continue
            with self.subTest(verb):
                manual = self.tilepack(verb, "--help")
                self.assertEqual(manual, self.tilepack("help", verb))
                self.assertIn(f"tilepack {verb}", manual.split("Example:")[1])


if __name__ == "__main__":
    unittest.main()
