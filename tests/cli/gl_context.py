"""OpenGL without a window or a GPU: EGL on Mesa's llvmpipe, by ctypes alone. One context a process."""

import ctypes
import os
import struct

os.environ.setdefault("LIBGL_ALWAYS_SOFTWARE", "1")

(TEXTURE_2D, TEXTURE_2D_ARRAY, RGBA32F, R16UI, RG32UI) = (0x0DE1, 0x8C1A, 0x8814, 0x8234, 0x823C)
(RGBA, RED_INTEGER, RG_INTEGER, FLOAT, UNSIGNED_INT, UNSIGNED_SHORT) = (0x1908, 0x8D94, 0x8228, 0x1406, 0x1405, 0x1403)
FRAMEBUFFER, COLOR_ATTACHMENT0 = 0x8D40, 0x8CE0
_VERTEX = """
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
"""


class GlError(Exception):
    """No context, or a shader that does not compile."""


class Gl:
    def __init__(self, embedded=False):
        try:
            egl = ctypes.CDLL("libEGL.so.1")
        except OSError as error:
            raise GlError(f"no libEGL.so.1 ({error})") from error
        egl.eglGetProcAddress.restype = ctypes.c_void_p
        egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
        platform_display = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
        if not platform_display:
            raise GlError("EGL knows no platforms")
        get = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p)(platform_display)
        display = ctypes.c_void_p(get(0x31DD, None, None))  # EGL_PLATFORM_SURFACELESS_MESA
        if not display or not egl.eglInitialize(display, None, None):
            raise GlError("EGL has no display without a surface")
        egl.eglBindAPI(0x30A0 if embedded else 0x30A2)
        asked = (ctypes.c_int * 7)(0x3098, 3, 0x30FB, 0 if embedded else 3, *((0x3038,) * 3))
        if not embedded:
            asked = (ctypes.c_int * 7)(0x3098, 3, 0x30FB, 3, 0x30FD, 1, 0x3038)  # core profile
        egl.eglCreateContext.restype = ctypes.c_void_p
        context = ctypes.c_void_p(egl.eglCreateContext(display, None, None, asked))
        if not context or not egl.eglMakeCurrent(display, None, None, context):
            raise GlError("EGL makes no context of OpenGL 3.3")
        self.egl = egl
        self.head = "#version 300 es\nprecision highp float;\nprecision highp int;\n" if embedded else "#version 330\n"
        if embedded:
            self.head += "".join(f"precision highp {kind};\n" for kind in
                                 ("sampler2D", "sampler2DArray", "usampler2D"))
        self.call("glGetString", 0x1F01, result=ctypes.c_char_p)
        array = ctypes.c_uint()
        self.call("glGenVertexArrays", 1, ctypes.byref(array))
        self.call("glBindVertexArray", array)

    def call(self, name, *arguments, result=None):
        address = self.egl.eglGetProcAddress(name.encode())
        if not address:
            raise GlError(f"no {name}")
        function = ctypes.CFUNCTYPE(result)(address)
        return function(*arguments)

    def renderer(self):
        return self.call("glGetString", 0x1F01, result=ctypes.c_char_p).decode()

    def program(self, fragment):
        program = self.call("glCreateProgram", result=ctypes.c_uint)
        for kind, text in ((0x8B31, self.head + _VERTEX), (0x8B30, self.head + fragment)):
            shader = self.call("glCreateShader", kind, result=ctypes.c_uint)
            lines = ctypes.c_char_p(text.encode())
            self.call("glShaderSource", shader, 1, ctypes.byref(lines), None)
            self.call("glCompileShader", shader)
            self.call("glAttachShader", program, shader)
            self._check(shader, "glGetShaderiv", 0x8B81, "glGetShaderInfoLog")
        self.call("glLinkProgram", program)
        self._check(program, "glGetProgramiv", 0x8B82, "glGetProgramInfoLog")
        self.call("glUseProgram", program)
        return program

    def _check(self, thing, asks, what, log):
        good = ctypes.c_int()
        self.call(asks, thing, what, ctypes.byref(good))
        if not good.value:
            text = ctypes.create_string_buffer(8192)
            self.call(log, thing, 8192, None, text)
            raise GlError(text.value.decode())

    def uniform(self, program, name, value):
        place = self.call("glGetUniformLocation", program, name.encode(), result=ctypes.c_int)
        if isinstance(value, float):
            self.call("glUniform1f", place, ctypes.c_float(value))
        else:
            self.call("glUniform1i" if value < 2**31 and name.startswith(("tiles", "corners", "ids")) else "glUniform1ui", place,
                      ctypes.c_uint(value))

    def texture(self, unit, levels, layers=0, internal=RGBA32F, kind=RGBA, component=FLOAT, linear=False, repeat=True):
        """levels: (width, height, bytes) each, finest first; height counts one layer."""
        target = TEXTURE_2D_ARRAY if layers else TEXTURE_2D
        name = ctypes.c_uint()
        self.call("glGenTextures", 1, ctypes.byref(name))
        self.call("glActiveTexture", 0x84C0 + unit)
        self.call("glBindTexture", target, name)
        self.call("glPixelStorei", 0x0CF5, 1)
        for level, (width, height, data) in enumerate(levels):
            if layers:
                self.call("glTexImage3D", target, level, internal, width, height, layers, 0, kind, component, data)
            else:
                self.call("glTexImage2D", target, level, internal, width, height, 0, kind, component, data)
        for what, value in ((0x813D, len(levels) - 1), (0x2801, 0x2703 if linear else 0x2700), (0x2800, 0x2601 if linear else 0x2600),
                            (0x2802, 0x2901 if repeat else 0x812F), (0x2803, 0x2901 if repeat else 0x812F)):
            self.call("glTexParameteri", target, what, value)
        return name

    def target(self, width, height, internal=RG32UI):
        """A picture to draw into: its texture, bound."""
        name, buffer = ctypes.c_uint(), ctypes.c_uint()
        self.call("glGenTextures", 1, ctypes.byref(name))
        self.call("glActiveTexture", 0x84C0 + 7)
        self.call("glBindTexture", TEXTURE_2D, name)
        kind, component = (RG_INTEGER, UNSIGNED_INT) if internal == RG32UI else (RGBA, FLOAT)
        self.call("glTexImage2D", TEXTURE_2D, 0, internal, width, height, 0, kind, component, None)
        self.call("glGenFramebuffers", 1, ctypes.byref(buffer))
        self.call("glBindFramebuffer", FRAMEBUFFER, buffer)
        self.call("glFramebufferTexture2D", FRAMEBUFFER, COLOR_ATTACHMENT0, TEXTURE_2D, name, 0)
        self.call("glViewport", 0, 0, width, height)
        if self.call("glCheckFramebufferStatus", FRAMEBUFFER, result=ctypes.c_uint) != 0x8CD5:
            raise GlError("such a picture can't be drawn into")
        self.size = (width, height, kind, component)

    def draw(self):
        """What the program in use draws, as bytes, the bottom row first."""
        width, height, kind, component = self.size
        self.call("glDrawArrays", 4, 0, 3)
        data = ctypes.create_string_buffer(width * height * (8 if kind == RG_INTEGER else 16))
        self.call("glReadPixels", 0, 0, width, height, kind, component, data)
        error = self.call("glGetError", result=ctypes.c_uint)
        if error:
            raise GlError(f"OpenGL error {error:#x}")
        return data.raw


def floats(values):
    return struct.pack(f"<{len(values)}f", *values)
