# vergence_shader(TARGET target SOURCE file.comp.glsl [DEFINES name=value...] [SUFFIX suffix])
#
# Compiles a compute shader and puts it on the target's include path as "shaders/<name>.hpp", which holds
# render::shaders::<name>, an array of SPIR-V words. <name> is the file's name up to its first dot, with _<suffix>
# behind it when one is given (the same shader built twice with different DEFINES). Includes start at the project root.
function(vergence_shader)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "TARGET;SOURCE;SUFFIX" "DEFINES")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_TARGET OR NOT arg_SOURCE)
    message(FATAL_ERROR "vergence_shader: TARGET and SOURCE are needed; not understood: '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  cmake_path(ABSOLUTE_PATH arg_SOURCE BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} NORMALIZE)
  get_filename_component(shader ${arg_SOURCE} NAME_WE)
  if(arg_SUFFIX)
    string(APPEND shader "_${arg_SUFFIX}")
  endif()
  set(defines ${arg_DEFINES})
  list(TRANSFORM defines PREPEND "-D")

  set(include_dir "${CMAKE_CURRENT_BINARY_DIR}/${arg_TARGET}_shaders")
  set(words "${include_dir}/shaders/${shader}.inc")
  file(CONFIGURE OUTPUT "${include_dir}/shaders/${shader}.hpp" CONTENT
"#pragma once

#include <cstdint>

namespace render::shaders {
inline constexpr std::uint32_t @shader@[] = {
#include \"@shader@.inc\"
};
}
" @ONLY)
  add_custom_command(OUTPUT "${words}"
    COMMAND Vulkan::glslc -fshader-stage=compute --target-env=vulkan1.2 -O -Werror -I "${PROJECT_SOURCE_DIR}" ${defines}
            -MD -MF "${words}.d" -MT "${words}" -mfmt=num -o "${words}" "${arg_SOURCE}"
    DEPENDS "${arg_SOURCE}"
    DEPFILE "${words}.d"
    COMMENT "Shader ${shader}"
    VERBATIM)
  target_sources(${arg_TARGET} PRIVATE "${words}")
  target_include_directories(${arg_TARGET} PRIVATE "${include_dir}")
endfunction()
