#pragma once

#include "tilepack/numeric/enum_names.h"

namespace tilepack {

/// The languages that lookups are written in.
enum class ShaderLanguage {
  glsl,     ///< GLSL 3.30, GLSL ES 3.00 and later
  hlsl,     ///< shader model 4 and later
  wgsl,     ///< of WebGPU
  gdshader, ///< an include of Godot 4
  osl,      ///< Open Shading Language
  tsl,      ///< a module of JavaScript for three.js
  c         ///< C99
};

template <>
inline constexpr auto enum_names<ShaderLanguage> =
    std::array{EnumName{ShaderLanguage::glsl, "glsl"}, EnumName{ShaderLanguage::hlsl, "hlsl"},
               EnumName{ShaderLanguage::wgsl, "wgsl"}, EnumName{ShaderLanguage::gdshader, "gdshader"},
               EnumName{ShaderLanguage::osl, "osl"},   EnumName{ShaderLanguage::tsl, "tsl"},
               EnumName{ShaderLanguage::c, "c"}};

} // namespace tilepack
