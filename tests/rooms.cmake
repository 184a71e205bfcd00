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
tks_wall(tetrakis_decoder "encoder" "ratecontrol" "study" "::")
tks_wall(tetrakis "study" "tks_files" "tks_conformance" "tks_cli" "PkgConfig" "GTest")
tks_wall(tks_stream "lattice" "wavelet" "geometry" "mesh" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_receiver "lattice" "wavelet" "geometry" "mesh" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_lattice "wavelet" "geometry" "mesh" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_synthesis "lattice" "geometry" "mesh" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_geometry "texture" "mesh" "ratecontrol" "tetrakis" "::")
tks_wall(tks_quadtree "track" "geometry" "texture" "ratecontrol" "tetrakis" "::")
tks_wall(tks_texture "geometry" "mesh" "ratecontrol" "tetrakis" "::")
tks_wall(tks_encoder_ways "texture" "tks_mesh" "tetrakis" "::")
tks_wall(tks_encoder_textures "geometry" "tks_mesh" "heights$" "tetrakis" "::")
tks_wall(tks_encoder "tetrakis" "::")
if(TARGET tks_reference)
  tks_wall(tks_reference
    "tks_(base|coder|track|stream|wavelet|geometry|mesh|texture|ratecontrol)" "tetrakis" "::")
endif()
