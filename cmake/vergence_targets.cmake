# The settings every target of ours shares: language level, warnings, sanitizers.
add_library(vergence_settings INTERFACE)
target_compile_features(vergence_settings INTERFACE cxx_std_20)
target_compile_options(vergence_settings INTERFACE -Wall -Wextra -Wconversion -Werror)
# A contraction or a reassociation would make the two engines round apart.
target_compile_options(vergence_settings INTERFACE -ffp-contract=off)
target_compile_definitions(vergence_settings INTERFACE GLM_FORCE_DEPTH_ZERO_TO_ONE GLM_ENABLE_EXPERIMENTAL)

option(VERGENCE_SANITIZE "Address and undefined-behaviour sanitizers" OFF)
if(VERGENCE_SANITIZE)
  target_compile_options(vergence_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(vergence_settings INTERFACE -fsanitize=address,undefined)
endif()

option(VERGENCE_FUZZ "Instrument for libFuzzer and build the harnesses; needs clang" OFF)
if(VERGENCE_FUZZ)
  target_compile_options(vergence_settings INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  target_link_options(vergence_settings INTERFACE -fsanitize=address,undefined)
endif()

# vergence_library(NAME SOURCES...): one static library a folder, named vergence_<folder>.
function(vergence_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC vergence_settings)
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()
