# The walls between rooms (docs/ARCHITECTURE.md), checked when CMake configures.

# tks_wall(TARGET REGEX...): no library that TARGET links may match.
function(tks_wall target)
  tks_closure(${target} libraries)
  foreach(regex IN LISTS ARGN)
    foreach(library IN LISTS libraries)
      if(library MATCHES "${regex}")
        message(FATAL_ERROR "${target} must not link ${library}")
      endif()
    endforeach()
  endforeach()
endfunction()

# The decoder is the WebAssembly build: no encoder, no rate control, nothing from outside.
tks_wall(tetrakis_decoder "encoder" "ratecontrol" "::")
tks_wall(tetrakis "tks_files" "tks_conformance" "tks_cli" "PkgConfig" "GTest")
tks_wall(tks_bitstream "codec" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_lattice "wavelet" "codec" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_wavelet "lattice" "codec" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_codec "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_mesh "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_quadtree "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_texture "codec" "mesh" "ratecontrol" "tetrakis" "::")
if(TARGET tks_reference)
  tks_wall(tks_reference "tks_(bitstream|codec|mesh|texture|ratecontrol)" "tetrakis" "::")
endif()
