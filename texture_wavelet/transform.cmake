tks_room(tks_texture_transform
  SOURCES colour.cpp colour_fit.cpp norms.cpp wavelet.cpp
  USES tks_bitstream)
