"""The table of languages and checks in lib/tilepack/shader/SHADERS.md, made by running the tests:

    python3 tests/bench/shader_languages.py build/release/tilepack build/release/tests/tests_shader

A cell says "held" where tests ran and passed, "FAILED", or that they did not run here."""

import os
import subprocess
import sys
import unittest

FOLDER = os.path.dirname(os.path.abspath(__file__))
# language -> check -> (module of tests/cli, test), or a text
CHECKS = ["compiles", "tiles of 10^7 cells", "texels", "filters", "a wrong constant shows", "fetches counted"]
C = "C"
ROWS = [
    ("C99 (`cc -std=c99 -pedantic`), against the reference sampler", [C, C, C, C, C, "-"]),
    ("GLSL on llvmpipe, against C", [("shader_glsl_test", "cells_have"), ("shader_glsl_test", "cells_have"),
                                   ("shader_glsl_test", "texels_are"), ("shader_glsl_test", "texels_are"),
                                   ("shader_glsl_test", "wrong_constant"), ("shader_spirv_test", "valid_and")]),
    ("GLSL, HLSL (glslang) and gdshader (read as GLSL) as SPIR-V on lavapipe, against C",
     [("shader_vulkan_test", "cells_have"), ("shader_vulkan_test", "cells_have"), ("shader_vulkan_test", "texels_are"), ("shader_vulkan_test", "texels_are"),
      ("shader_vulkan_test", "wrong_constant"), ("shader_spirv_test", "valid_and")]),
    ("HLSL, as GLSL again on llvmpipe, against C", [("shader_spirv_test", "valid_and"), ("shader_spirv_test", "hlsl_finds"), "-", "-",
                                                 ("shader_spirv_test", "hlsl_finds"), ("shader_spirv_test", "valid_and")]),
    ("WGSL by Dawn on SwiftShader, against C", [("shader_wgsl_test", "cells_have"), ("shader_wgsl_test", "cells_have"),
                                              ("shader_wgsl_test", "texels_are"), ("shader_wgsl_test", "texels_are"),
                                              ("shader_wgsl_test", "wrong_constant"), "-"]),
    ("GLSL ES in Chromium (`view`), against `render`", [("view_test", "browser"), "1024 cells", ("view_test", "browser"),
                                                     ("view_test", "browser"), "not run", "-"]),
    ("TSL by three.js and Dawn on SwiftShader, against C", [("shader_tsl_test", "cells_have"), ("shader_tsl_test", "cells_have"),
                                                         ("shader_tsl_test", "texels"), ("shader_tsl_test", "texels"),
                                                         ("shader_tsl_test", "cells_have"), "-"]),
    ("gdshader in Godot 3.2.3 on llvmpipe (literals and tables in its older words), against C",
     [("shader_godot_test", "cells_have"), ("shader_godot_test", "cells_have"), ("shader_godot_test", "texels"), ("shader_godot_test", "texels"),
      ("shader_godot_test", "cells_have"), "-"]),
    ("OSL", ["generated, not run here"] + ["not run"] * 4 + ["-"]),
]


def main():
    os.environ["TILEPACK"] = os.path.abspath(sys.argv[1])
    os.environ["TILEPACK_SOURCE"] = os.path.dirname(os.path.dirname(FOLDER))
    sys.path.insert(0, os.path.join(os.path.dirname(FOLDER), "cli"))
    program = sys.argv[2]
    state = {C: "held" if subprocess.run([program], stdout=subprocess.DEVNULL, check=False).returncode == 0 else "FAILED"}
    for module in sorted({cell[0] for _, cells in ROWS for cell in cells if isinstance(cell, tuple)}):
        suite = unittest.defaultTestLoader.loadTestsFromName(module)
        tests = {test.id(): "held" for group in suite for test in group}
        result = unittest.TextTestRunner(stream=sys.stderr, verbosity=2).run(suite)
        for test, _ in result.failures + result.errors:
            tests[getattr(test, "test_case", test).id()] = "FAILED"
        for test, _ in result.skipped:
            tests[test.id()] = "not run here"
        state.update(tests)
    print("| language | " + " | ".join(CHECKS) + " |\n|" + "---|" * (len(CHECKS) + 1))
    for name, cells in ROWS:
        said = []
        for cell in cells:
            if isinstance(cell, tuple):
                said.append(next(what for test, what in state.items() if test.startswith(cell[0]) and cell[1] in test))
            else:
                said.append(state.get(cell, cell))
        print(f"| {name} | " + " | ".join(said) + " |")
    return "FAILED" in state.values()


if __name__ == "__main__":
    sys.exit(main())
