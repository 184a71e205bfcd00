# Headless pictures of meshes, cameras, screen-space distortion.
pkg_check_modules(TKS_GRAPHICS REQUIRED IMPORTED_TARGET GLOBAL egl glesv2 nlohmann_json)

tks_room(tks_render
  SOURCES camera.cpp camera_file.cpp egl_context.cpp gl_program.cpp projection.cpp render.cpp
    screen_psnr.cpp texture_pyramid.cpp
  USES tks_bitstream)
target_link_libraries(tks_render PRIVATE PkgConfig::TKS_GRAPHICS)
